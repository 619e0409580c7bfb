#pragma once

#include "viewer/stability/finding.h"

/// What must not change the light.
namespace lightwell::stability {

std::vector<Finding> reciprocity();   ///< F19
std::vector<Finding> turned_frame();  ///< F20
std::vector<Finding> linearity();     ///< F21
std::vector<Finding> any_scale();
std::vector<Finding> nothing_to_see();
std::vector<Finding> many_lamps();

}  // namespace lightwell::stability
