#pragma once

#include "radiance4d/operator/global_transport.h"
#include "radiance4d/progress.h"
#include "solver/ground.h"
#include "solver/precompute.h"
#include "solver/settings.h"
#include "solver/stage_clock.h"
#include "solver/transport/oracle.h"

namespace lightwell {

/// First guesses for surfaces whose light has directions: cells twice as wide as on diffuse ones,
/// since the light that one sees in a glossy surface varies with the place by way of its direction,
/// and a truncation that stays above the noise of the rays that sampled the directions.
Settings glossy_settings(const PrecomputeOptions& options, const Ground& ground);

/// The operators of a scene with glossy surfaces, whose light is carried by direction, for given
/// settings: elements with angular functions, directed links, the propagation P, and the global
/// transport operator H = T + T^2 + ..., T = P R (WRT section 4 in full). The oracle is always the
/// geometric one. Otherwise as diffuse_operator.
GlobalTransport glossy_operator(const Ground& ground, const PrecomputeOptions& options,
                                const Settings& settings, const Progress& progress,
                                OracleCost& cost, StageClock& clock, PrecomputeReport& report);

}  // namespace lightwell
