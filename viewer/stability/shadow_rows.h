#pragma once

#include "viewer/stability/finding.h"

/// Shadows of light straight from lamps and emitting quads.
namespace lightwell::stability {

std::vector<Finding> small_occluder();      ///< F4
std::vector<Finding> shadow_edge();         ///< F5
std::vector<Finding> penumbra();            ///< F6
std::vector<Finding> occlusion_aliasing();  ///< F15
std::vector<Finding> rays_along_edges();    ///< a lamp in the planes of a block's faces

}  // namespace lightwell::stability
