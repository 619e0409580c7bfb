#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "runtime/projection/light_projection.h"

namespace lightwell {

/// Seconds on a clock that only goes forwards.
using SecondsClock = std::function<double()>;
double steady_seconds();

/// Of several ways to project light, the one that is fastest on this machine: each projects the
/// lights twice, since the first time may have to get memory, and the second one counts.
/// @param ways       at least one; their contexts must be current
/// @param few        lights that reach little: a way that takes far longer for these than one
///                   before took for all is given up, since somebody is waiting
/// @param functions  of the space that they project on
std::unique_ptr<LightProjection> fastest_projection(
    std::vector<std::unique_ptr<LightProjection>> ways, const std::vector<Light>& few,
    const std::vector<Light>& lights, std::uint32_t functions,
    const SecondsClock& clock = steady_seconds);

}  // namespace lightwell
