#pragma once

#include "viewer/stability/finding.h"

/// Light straight from lamps and emitting quads, wherever these are.
namespace lightwell::stability {

std::vector<Finding> grazing_receiver();   ///< F11
std::vector<Finding> direction_map_rim();  ///< F12
std::vector<Finding> spot_cone_edge();     ///< F22
std::vector<Finding> opening_edge();       ///< F23
std::vector<Finding> lamp_on_a_surface();
std::vector<Finding> lamp_outside();

}  // namespace lightwell::stability
