#pragma once

#include <Eigen/SparseCore>

#include "solver/series/neumann_series.h"

namespace lightwell {

/// The matrix without the smallest coefficients between the means of whole elements: of each row as
/// many as together bring it at most `share` of the light that its means expect (the sum of
/// |a_ij| weight_j). Judged row by row, since a small element must not go dark because all that it
/// receives is little for the scene; and by plain sums, since what comes to a mean is positive and
/// adds up.
///
/// The means are the square of the elements, which in a building is half of all coefficients,
/// between rooms that hardly see each other's light.
///
/// @param share  in [0,1); 0 leaves out none
Eigen::SparseMatrix<double> without_small_means(const Eigen::SparseMatrix<double>& matrix,
                                                const TruncationRule& rule, double share);

}  // namespace lightwell
