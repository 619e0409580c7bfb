#pragma once

#include "radiance4d/operator/global_transport.h"
#include "radiance4d/progress.h"
#include "solver/series/bounce_truncation.h"
#include "solver/series/light_ensemble.h"
#include "solver/series/trial_lights.h"

namespace lightwell {

/// How much leaving coefficients out may change the indirect light of lights that the weights were
/// not made from: relative, root mean square over the lights. Measured and not inferred from the
/// coefficients' squares: what is left out of one row has mostly one sign, so that the errors of
/// different columns add up three to five times as high as if they were independent.
struct TruncationTarget {
    double bounce = 0;  ///< by coefficients of M; 0 keeps all
    double global = 0;  ///< by coefficients of H, against the light solved on M; 0 keeps all
};

/// M with as few coefficients as the target allows.
///
/// @param truncation   of all coefficients
/// @param tried        direct light of the trial lights
/// @param reflectance  by basis function, one channel that stands for all
SymmetricOperator truncated_bounce(BounceTruncation truncation, const TrialLights& tried,
                                   const Eigen::ArrayXd& reflectance,
                                   const TruncationTarget& target, const Progress& progress);

/// Sums the Neumann series of every distinct channel into transport.indirect, transport.channel and
/// the provenance's bounces, with as few coefficients as the target allows. The scene, the space
/// and the bounce operator are there already.
///
/// @param weight  LightEnsemble::direct
/// @throws InputError  if the series has no sum, as the bounce operator gains light: one whose
///                     links the paper's oracle sampled too coarsely can
void sum_series(const Eigen::ArrayXd& weight, const TrialLights& tried,
                const TruncationTarget& target, const Progress& progress,
                GlobalTransport& transport);

}  // namespace lightwell
