#pragma once

#include "radiance4d/operator/global_transport.h"
#include "radiance4d/progress.h"
#include "solver/series/bounce_truncation.h"
#include "solver/series/calibrated_truncation.h"
#include "solver/series/directed_solver.h"

namespace lightwell {

// The counterparts of calibrated_truncation.h for spaces with angular functions, where reflection R
// is no diagonal: one bounce is T = P R, and H = P (R H) + P R.

/// How much a basis function can be expected to carry, over point lights anywhere in the scene,
/// each scaled so that its indirect light has norm one.
struct DirectedWeights {
    Eigen::ArrayXd direct;    ///< root mean square of the direct light: what columns of H see
    Eigen::ArrayXd outgoing;  ///< of R (E + H E): what columns of P see
};

/// Weights from lights, a few at a time, and the propagation. They steer truncation and nothing
/// else, so that a propagation without its smallest coefficients serves as well. Keeps references.
class DirectedEnsemble {
  public:
    DirectedEnsemble(const SymmetricOperator& propagation, const RadianceSpace& space,
                     const Reflection& reflection);

    /// Further lights, enough to tell how bright indirect light is on the mean: one that almost
    /// nothing reflects is scaled as if a quarter of that were reflected.
    /// @throws Interrupted if the progress says so
    void add(const std::vector<DirectedLights>& lights, const Progress& progress);

    /// Ones where nothing reflects any of the lights.
    DirectedWeights weights() const;

  private:
    const SymmetricOperator& propagation_;
    const RadianceSpace& space_;
    const Reflection& reflection_;
    DirectedSolver solver_;
    Reflection::Functions all_;         ///< functions of the space
    Eigen::ArrayXd direct_, outgoing_;  ///< sums of squares over the lights
    double lights_ = 0;                 ///< that anything reflects
};

/// P with as few coefficients as the target allows. Changes of light count as they are seen: by
/// Reflection::visibility.
SymmetricOperator truncated_propagation(BounceTruncation truncation, const DirectedWeights& weights,
                                        const Reflection& reflection,
                                        const std::vector<DirectedLights>& tried, double target,
                                        const Progress& progress);

/// R of a channel (see Reflection::matrix) as a factor of T = P R: without the rows that meet no
/// column of P, and without coefficients below 2e-4, since the norm of R is one at most.
Eigen::SparseMatrix<double> reflection_into(const Eigen::SparseMatrix<double>& propagation,
                                            const Reflection& reflection, const Rgb& shares);

/// As sum_series. The scene, the space, the propagation and the reflection are there already.
void sum_directed_series(const DirectedWeights& weights, const std::vector<DirectedLights>& tried,
                         double target, const Progress& progress, GlobalTransport& transport);

}  // namespace lightwell
