#pragma once

#include "solver/precompute.h"

namespace lightwell {

/// The offline pipeline for scenes with glossy surfaces, whose light is carried by direction:
/// elements with angular functions, directed links, the propagation P, and the global transport
/// operator H = T + T^2 + ..., T = P R (WRT section 4 in full).
///
/// @throws as precompute
GlobalTransport precompute_glossy(const Scene& scene, const PrecomputeOptions& options,
                                  const Progress& progress, PrecomputeReport& report);

}  // namespace lightwell
