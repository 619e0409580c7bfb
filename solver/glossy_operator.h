#pragma once

#include "radiance4d/operator/global_transport.h"
#include "radiance4d/progress.h"
#include "solver/earlier_work.h"
#include "solver/ground.h"
#include "solver/precompute.h"
#include "solver/settings.h"
#include "solver/stage_clock.h"
#include "solver/transport/oracle.h"

namespace lightwell {

/// Truncation of glossy scenes, over that of diffuse ones: it stays above the noise of the points
/// that told the directions. Between 1 and 2: less where little is glossy.
double glossy_looseness(const Ground& ground);

/// First guesses for scenes with gloss: a looser truncation, and cells that are wider than in
/// diffuse scenes but on glossy sides. Both hardly where little is glossy.
Settings glossy_settings(const PrecomputeOptions& options, const Ground& ground);

/// As tighten, for scenes with gloss: directions are cut once more as well, and cells where much is
/// missing.
void tighten_glossy(const PrecomputeOptions& options, double missed, Settings& settings);

/// The same with finer cells in place of finer directions, unless their size is set by hand.
void tighten_glossy_cells(const PrecomputeOptions& options, double missed, Settings& settings);

/// Basis functions at given settings.
double glossy_functions(const Ground& ground, const PrecomputeOptions& options,
                        const Settings& settings);

/// Memory [bytes] that so many functions take to compute, about: they are tried on all lights that
/// are expected, side by side; without truncation their operators are dense.
double glossy_memory_for(const Ground& ground, double functions, double truncation);

/// The operators of a scene with glossy surfaces, whose light is carried by direction, for given
/// settings: elements with angular functions, directed links, the propagation P, and the global
/// transport operator H = T + T^2 + ..., T = P R (WRT section 4 in full). The oracle is always the
/// geometric one. Nothing is carried over from an earlier one, whose cells are wider. Otherwise as
/// diffuse_operator, memory included.
GlobalTransport glossy_operator(const Ground& ground, const PrecomputeOptions& options,
                                const Settings& settings, const Progress& progress,
                                EarlierWork& earlier, OracleCost& cost, StageClock& clock,
                                PrecomputeReport& report);

}  // namespace lightwell
