#pragma once

#include "viewer/stability/finding.h"

/// Lamps that move.
namespace lightwell::stability {

std::vector<Finding> flicker();   ///< F16
std::vector<Finding> ghosting();  ///< F17

}  // namespace lightwell::stability
