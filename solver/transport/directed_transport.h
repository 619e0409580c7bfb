#pragma once

#include <vector>

#include "radiance4d/progress.h"
#include "solver/transport/coefficients.h"
#include "solver/transport/directed_links.h"

namespace lightwell {

/// The colourless propagation P in the standard decomposition over space and direction on both
/// sides: <b_r, P b_s> with b = b_space * b_angle, so that a single bounce is T = P R (WRT eq. 4
/// with the BRDF taken out; see Reflection). A link gives to its supports
///     exchange / sqrt(|X| |A| |Y| |B|),
/// and coarser coefficients are the exact transform of finer ones along all four sub-domains.
/// Without angular functions it is direct_transport.
///
/// Ordered by column, then row. Coefficients that are zero to rounding are left out.
std::vector<Coefficient> directed_transport(const RadianceSpace& space,
                                            const std::vector<DirectedPair>& pairs,
                                            const Progress& progress);

}  // namespace lightwell
