#pragma once

#include <cstdint>
#include <vector>

namespace lightwell {

/// The largest threshold t such that leaving out all magnitudes below t costs at most `budget` in
/// the root of the sum of squares. Infinity if everything may go; 0 if nothing may.
///
/// Magnitudes are coefficients weighted by how much light their column can carry, so the sum of
/// squares is the expected squared error over the ensemble of lights when errors of different
/// columns are independent.
double threshold_for_budget(const std::vector<double>& magnitudes, double budget);

}  // namespace lightwell
