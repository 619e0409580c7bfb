#pragma once

#include <cstdint>
#include <vector>

#include "viewer/charts/chart.h"
#include "viewer/charts/judged_scene.h"

namespace lightwell {

/// What truncation does to an operator, threshold by threshold (WRT figures 4, 6 and 7). Errors are
/// in per cent, coefficients those of all channels together.
struct TruncationStudy {
    std::uint64_t cells = 0;                     ///< of the operator
    std::vector<Series> coefficients_of_powers;  ///< of T^n against n, one series a threshold
    /// Against the threshold: error of the GTO and of the gathered GTO as path tracing judges them,
    /// and against the light that the whole operator makes; and of that itself, as it is judged.
    Series judged_global, judged_gathered, own_global, own_gathered, judged_whole;
    /// Judged error against the coefficients of H: of the GTO, of the gathered GTO, and of H where
    /// of all its coefficients the N are kept that weigh most for the lamps that judge.
    Series global_by_size, gathered_by_size, best_by_size;
};

/// Sums the series of a diffuse operator anew with different thresholds, all channels. One
/// threshold holds for all coefficients and bounces, as in WRT section 4.4; precompute finds its
/// thresholds by trial lights and keeps what passes between whole elements longer.
///
/// Thresholds are relative: a coefficient is dropped when it adds less than that share of the light
/// to what a lamp can be expected to make of it.
///
/// @param transport  with as much of M as can be had; its H is not looked at. All of H is solved
///                   for, in memory for the square of its functions
TruncationStudy study_of_truncation(const GlobalTransport& transport, const ChartedScene& scene,
                                    const JudgedScene& judge, const std::vector<double>& thresholds,
                                    const Progress& progress);

}  // namespace lightwell
