#pragma once

#include <string>
#include <vector>

#include "radiance4d/progress.h"
#include "solver/precompute.h"
#include "viewer/charts/judged_scene.h"
#include "viewer/charts/measured_setting.h"

namespace lightwell {

/// An operator, and what it took.
struct BuiltOperator {
    GlobalTransport transport;
    double seconds = 0;         ///< without reading, judging and writing
    double series_seconds = 0;  ///< of these, from one bounce to all
    double cells = 0;
};

/// Builds one operator, without judging it.
BuiltOperator built(const ChartedScene& scene, const PrecomputeOptions& options,
                    const Progress& progress);

/// Whether all coefficients are finite: links that are computed from too few samples may give back
/// more light than they get, and then the series has no sum.
bool has_sum(const GlobalTransport& transport);

/// Ways to show light by one operator that are looked at.
enum class Ways { gathered, gathered_and_stored, all };

/// One operator as each of up to three ways shows it: the gathered operator ("METHOD: gathered"), G
/// stored and T iterated at run time.
/// @param scratch  a file to be written and removed again, to know sizes
std::vector<MeasuredSetting> measured(const std::string& method, const std::string& setting,
                                      const BuiltOperator& built, const ChartedScene& scene,
                                      const JudgedScene& judge, const std::string& scratch,
                                      Ways ways);

/// Path tracing of every texel anew in each frame, at equal errors: its noise falls with the square
/// root of its paths.
/// @param texels  places that a frame needs the light of
std::vector<MeasuredSetting> path_traced(const std::vector<double>& errors, double texels,
                                         const ChartedScene& scene, const JudgedScene& judge);

}  // namespace lightwell
