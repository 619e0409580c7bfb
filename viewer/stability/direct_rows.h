#pragma once

#include "viewer/stability/finding.h"

/// Light straight from lamps and emitting quads, and its shadows.
namespace lightwell::stability {

std::vector<Finding> small_occluder();      ///< F4
std::vector<Finding> shadow_edge();         ///< F5
std::vector<Finding> penumbra();            ///< F6
std::vector<Finding> grazing_receiver();    ///< F11
std::vector<Finding> direction_map_rim();   ///< F12
std::vector<Finding> occlusion_aliasing();  ///< F15
std::vector<Finding> spot_cone_edge();      ///< F22
std::vector<Finding> opening_edge();        ///< F23
std::vector<Finding> rays_along_edges();    ///< a lamp in the planes of a block's faces
std::vector<Finding> lamp_on_a_surface();
std::vector<Finding> lamp_outside();

}  // namespace lightwell::stability
