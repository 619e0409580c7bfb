#pragma once

#include <cstdint>
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
    double seconds = 0;         ///< without reading and writing
    double series_seconds = 0;  ///< of these, from one bounce to all
    std::uint64_t cells = 0;
    std::uint64_t judge_rays = 0;  ///< traced to judge it
};

/// Builds one operator as the options say. Short work is done again, up to three times in all, for
/// the shortest time.
BuiltOperator built(const ChartedScene& scene, const PrecomputeOptions& options,
                    const Progress& progress);

/// Builds one operator, without judging it.
BuiltOperator built_once(const ChartedScene& scene, PrecomputeOptions options,
                         const Progress& progress);

/// Ways to show light by one operator that are looked at.
enum class Ways { gathered, gathered_and_stored, all };

/// What is charted of a method, and how it looks.
struct Method {
    std::string name;  ///< "default"
    int colour = 0;    ///< see SeriesLook
    Ways ways = Ways::gathered;
    bool is_one_of_a_line = true;  ///< see MeasuredSetting
};

/// One operator as each of up to three ways shows it: the gathered operator ("METHOD: gathered"), G
/// stored and T iterated at run time.
std::vector<MeasuredSetting> measured(const Method& method, const std::string& setting,
                                      const BuiltOperator& built, const ChartedScene& scene,
                                      const JudgedScene& judge);

/// Path tracing of as many texels as others have cells, anew in each frame, to the errors that they
/// have: from the noise of a few paths, which falls with the square root of their number. Its
/// intervals have no length, since nothing is measured at these errors.
std::vector<MeasuredSetting> path_traced(const std::vector<MeasuredSetting>& others, int colour,
                                         const ChartedScene& scene, const JudgedScene& judge);

}  // namespace lightwell
