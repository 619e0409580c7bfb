#pragma once

#include "viewer/stability/finding.h"

/// How the light lies on surfaces, near edges and from cell to cell.
namespace lightwell::stability {

std::vector<Finding> corner_singularity();  ///< F1
std::vector<Finding> blocks();              ///< F7
std::vector<Finding> t_vertices();          ///< F13
std::vector<Finding> ringing();             ///< F18

}  // namespace lightwell::stability
