#pragma once

#include <vector>

#include "viewer/charts/chart.h"
#include "viewer/charts/judged_scene.h"

namespace lightwell {

/// What truncation does to an operator, threshold by threshold (WRT figures 4, 6 and 7).
struct TruncationStudy {
    std::vector<Series> coefficients_of_powers;  ///< of T^n against n, one series a threshold
    Series error_of_global;                      ///< error [%] of the GTO against the threshold
    Series error_of_gathered;                    ///< of the gathered GTO
    /// Judged error [%] against the coefficients of H: of the GTO, of the gathered GTO, and of the
    /// best possible choice of N coefficients of H.
    Series global_by_size, gathered_by_size, best_by_size;
};

/// Sums the series of an operator anew with different thresholds, all channels.
///
/// Thresholds are relative: a coefficient is dropped when it adds less than that share of the light
/// to what a lamp can be expected to make of it. The best possible N coefficients are those of the
/// whole series that weigh most for the very lamps that judge.
///
/// @param transport  with as much of M as can be had
TruncationStudy study_of_truncation(const GlobalTransport& transport, const ChartedScene& scene,
                                    const JudgedScene& judge, const std::vector<double>& thresholds,
                                    const Progress& progress);

}  // namespace lightwell
