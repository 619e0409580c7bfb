#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "radiance4d/progress.h"

namespace lightwell {

/// Which coefficients of a product of operators are kept.
struct TruncationRule {
    /// By column: expected magnitude of that coefficient of the light, in units in which the
    /// light's indirect part has norm one (see LightEnsemble).
    Eigen::ArrayXd weight;
    /// A coefficient a_ij is dropped when visibility_i |a_ij| weight_j is below this.
    double threshold = 0;
    /// By basis function: whether it is the scaling function of a whole element. Coefficients
    /// between two of these are never dropped.
    std::vector<bool> is_mean;
    /// By row: how much it matters what arrives there, in [0,1]; empty if all rows matter alike.
    Eigen::ArrayXd visibility = {};
    /// Terms of a product that count for less than this share of the threshold are left out before
    /// they are added up, but for those between means; >= 0, 0 leaves out none. Most terms of
    /// products of directed operators are far below the threshold.
    double negligible = 0;
};

/// What a coefficient counts for.
double weighted(const TruncationRule& rule, Eigen::Index row, Eigen::Index column, double value);

/// Whether the rule keeps a coefficient.
bool is_kept(const TruncationRule& rule, Eigen::Index row, Eigen::Index column, double value);

/// The matrix without the coefficients that the rule drops.
Eigen::SparseMatrix<double> truncated(const Eigen::SparseMatrix<double>& matrix,
                                      const TruncationRule& rule);

/// A B, truncated column by column while it is formed, so that the full product never exists.
/// Columns are independent and run in parallel; the result does not depend on the number of
/// threads. (Eigen's own product is single-threaded and truncates afterwards; measured 1.4 to 3.2
/// times slower on such matrices even on one thread.)
Eigen::SparseMatrix<double> truncated_product(const Eigen::SparseMatrix<double>& a,
                                              const Eigen::SparseMatrix<double>& b,
                                              const TruncationRule& rule,
                                              const Progress& progress = {});

/// H = T + T^2 + ..., and how far it went.
struct NeumannSeries {
    Eigen::SparseMatrix<double> sum;
    int bounces = 0;  ///< highest power of T that the sum holds
};

/// Sums the Neumann series by doubling, H_2n = H_n + T^n H_n and T^2n = T^n T^n, one threshold for
/// all powers (WRT section 4.4), until every coefficient of T^n is below the threshold. The
/// spectral radius of T must be below one, which any physical scene ensures.
NeumannSeries neumann_series(const Eigen::SparseMatrix<double>& transport,
                             const TruncationRule& rule, const Progress& progress);

}  // namespace lightwell
