#pragma once

#include "viewer/stability/finding.h"

/// What must add up.
namespace lightwell::stability {

std::vector<Finding> bright_room();       ///< F8
std::vector<Finding> truncated_energy();  ///< F9
std::vector<Finding> truncated_series();  ///< F10
std::vector<Finding> crossing_quads();    ///< F14
std::vector<Finding> needle_quads();
std::vector<Finding> black_and_white();

}  // namespace lightwell::stability
