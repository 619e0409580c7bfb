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

/// How many times as wide as in a diffuse scene the cells of diffuse sides are, and as loose the
/// truncation: 2, less where little is glossy. Glossy sides have cells as in a diffuse scene.
///
/// What diffuse sides get from glossy ones is known no better than its directions, and finer cells
/// show where one direction ends. Light in scenes/glossy is 7.0 % off where cells of the floor are
/// 0.2 m wide and those of the walls 0.4 m; 7.3 % with 0.2 m everywhere, at three times as many
/// links; 8.2 % with 0.1 m on the walls; 11.0 % with 0.4 m everywhere; all with 64 directions. So
/// does truncation stay above the noise of the points that told the directions.
double glossy_looseness(const Ground& ground);

/// First guesses for scenes with gloss: as loose as that.
Settings glossy_settings(const PrecomputeOptions& options, const Ground& ground);

/// As tighten, for scenes with gloss: the directions of the coarsest lobes are cut once more as
/// well; so are cells where much is missing, or no lobe can have finer directions.
void tighten_glossy(const Ground& ground, const PrecomputeOptions& options, double missed,
                    Settings& settings);

/// The same with finer cells in place of finer directions, unless their size is set by hand.
void tighten_glossy_cells(const Ground& ground, const PrecomputeOptions& options, double missed,
                          Settings& settings);

/// Basis functions at given settings.
double glossy_functions(const Ground& ground, const PrecomputeOptions& options,
                        const Settings& settings);

/// Memory [bytes] that so many functions take to compute, about: they are tried on lights that are
/// expected, some side by side; without truncation their operators are dense.
double glossy_memory_for(const Ground& ground, double functions, double truncation);

/// The operators of a scene with glossy surfaces, whose light is carried by direction, for given
/// settings: elements with angular functions, directed links, the propagation P, and the global
/// transport operator H = T + T^2 + ..., T = P R (WRT section 4 in full). The oracle is always the
/// geometric one. Nothing is carried over from an earlier one, whose cells or directions are wider.
/// Otherwise as diffuse_operator, memory included.
GlobalTransport glossy_operator(const Ground& ground, const PrecomputeOptions& options,
                                const Settings& settings, const Progress& progress,
                                EarlierWork& earlier, OracleCost& cost, StageClock& clock,
                                PrecomputeReport& report);

}  // namespace lightwell
