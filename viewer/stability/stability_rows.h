#pragma once

#include "viewer/stability/finding.h"

namespace lightwell::stability {

/// The rows of the table of failure modes, "F1" to "F23", and those that were added to them.
const std::vector<StabilityRow>& stability_rows();

}  // namespace lightwell::stability
