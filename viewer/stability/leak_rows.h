#pragma once

#include "viewer/stability/finding.h"

/// Light and shadow where they should not be.
namespace lightwell::stability {

std::vector<Finding> light_leak();   ///< F2
std::vector<Finding> shadow_leak();  ///< F3

}  // namespace lightwell::stability
