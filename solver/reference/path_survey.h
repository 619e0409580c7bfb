#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "solver/reference/light_estimate.h"
#include "solver/reference/light_walk.h"
#include "solver/reference/noise_target.h"

namespace lightwell {

/// How paths are traced.
struct PathTracing {
    int samples = 1024;      ///< paths per place; rounded up to a whole number per batch
    int batches = 32;        ///< independent groups, whose scatter gives the error; at least 2
    int roulette_after = 3;  ///< bounces that every path makes; then it goes on with chance albedo
    std::uint64_t seed = 1;
};

/// Light at places, in the order asked.
struct LightSurvey {
    std::vector<LightEstimate> at;
    std::int64_t rays = 0;   ///< traced, of all kinds
    std::int64_t paths = 0;  ///< traced
};

/// One path's worth of light at a place, without bias. Adds the rays traced to `rays`.
using LightOfPath = std::function<Rgb(std::size_t place, PathChoices& choices, std::int64_t& rays)>;

/// Light at each place from how.samples paths. Every random number depends on the seed and the
/// place only, so results do not depend on the number of threads.
LightSurvey survey_by_paths(std::size_t places, const PathTracing& how, const LightOfPath& light);

/// Light to a given noise. A trial run with how.samples paths tells how many each place needs; a
/// fresh run, whose length its own outcome cannot influence, is the answer. rays and paths count
/// both runs.
LightSurvey survey_to_noise(const NoiseTarget& target, std::size_t places, const PathTracing& how,
                            const LightOfPath& light);

}  // namespace lightwell
