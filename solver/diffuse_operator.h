#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "radiance4d/progress.h"
#include "solver/earlier_work.h"
#include "solver/ground.h"
#include "solver/precompute.h"
#include "solver/settings.h"
#include "solver/stage_clock.h"
#include "solver/transport/oracle.h"

namespace lightwell {

/// The finest cells of all elements at given settings.
double cells_at(const Ground& ground, const Settings& settings);

/// Memory [bytes] that the operators of so many cells take to compute, about; without truncation
/// they are dense.
double memory_for(double cells, double truncation);

/// @param needed     memory [bytes] that so many cells take
/// @param truncated  memory that they would take with truncation
/// @throws MemoryExceeded if it is more than is allowed
void require_memory(double cells, double needed, double truncated, std::uint64_t max_memory);

/// The operators of a scene without gloss for given settings: elements, links, direct transport
/// operator, Neumann series (WRT sections 4.2 to 4.4). All of its provenance is still to be filled
/// in but links and bounces.
///
/// @param earlier  of an operator of no tighter settings: where the cells are the same, links are
///                 refined on from its; receives what this one leaves, if attempts may follow
/// @param cost     receives the rays
/// @throws MemoryExceeded  if it cannot be computed within options.max_memory: first where the
///                         number of cells tells, or as soon as there are too many links
/// @throws Interrupted     if the progress says so
GlobalTransport diffuse_operator(const Ground& ground, const PrecomputeOptions& options,
                                 const Settings& settings, const Progress& progress,
                                 EarlierWork& earlier, OracleCost& cost, StageClock& clock,
                                 PrecomputeReport& report);

}  // namespace lightwell
