#pragma once

#include <functional>
#include <vector>

#include "radiance4d/operator/reflection.h"
#include "radiance4d/operator/transport_operator.h"
#include "radiance4d/progress.h"
#include "solver/series/neumann_series.h"

namespace lightwell {

/// Fields of eight lights side by side: one row per basis function.
using LightBlock = Eigen::Array<double, Eigen::Dynamic, 8, Eigen::RowMajor>;

/// Lights to try an operator on: as many blocks as it takes; a block may be filled up with zeros.
using TrialLights = std::vector<LightBlock>;

/// Packs fields of one channel into blocks.
TrialLights trial_lights(const std::vector<Eigen::ArrayXd>& fields);

/// M x.
LightBlock propagated(const SymmetricOperator& bounce, const LightBlock& x);
/// The same into y, which is made as large as x; not x itself.
void propagate(const SymmetricOperator& bounce, const Reflection::Fields& x, Reflection::Fields& y);

/// Indirect light x = T (E + x), T = M diag(reflectance), solved to 1e-4: by correction steps with
/// H (I + H, an approximate inverse of I - T), or, without one, by at most 40 plain iterations.
/// Blocks run in parallel.
///
/// @param global  H, or nullptr
TrialLights solved_indirect(const SymmetricOperator& bounce, const Eigen::ArrayXd& reflectance,
                            const Eigen::SparseMatrix<double>* global, const TrialLights& direct,
                            const Progress& progress);

/// H E without the coefficients that the rule drops.
TrialLights truncated_indirect(const Eigen::SparseMatrix<double>& global,
                               const TruncationRule& rule, const TrialLights& direct);

/// Root mean square over the lights of ||changed - reference|| / ||reference||. A light of little
/// indirect light counts as if it had half of the rms.
double relative_change(const TrialLights& changed, const TrialLights& reference);
double relative_change(const std::vector<Reflection::Fields>& changed,
                       const std::vector<Reflection::Fields>& reference);

/// The threshold, within 5 % of it, at which the error reaches `wanted`, by secant steps in the
/// logarithms from a first guess; the error grows with the threshold. Of those tried, the largest
/// whose error is at most `wanted`; 0 if there was none.
double calibrated_threshold(double guess, double wanted,
                            const std::function<double(double)>& error_at);

}  // namespace lightwell
