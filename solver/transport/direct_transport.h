#pragma once

#include <functional>
#include <vector>

#include "radiance4d/operator/transport_operator.h"
#include "radiance4d/progress.h"
#include "solver/transport/coefficients.h"
#include "solver/transport/link.h"

namespace lightwell {

/// The colourless geometric operator M in the standard decomposition, all its coefficients: <b_r, M
/// b_s> with M = Int F V, so that a single bounce is T = M diag(rho) (WRT eq. 3 for diffuse
/// surfaces). The links of each pair of elements are transformed on both sides: coefficients of
/// coarse supports are the exact transform of finer ones, never sampled anew (WRT section 4.3.1).
///
/// Ordered by column, then row. Coefficients that are zero to rounding are left out. Links are
/// forgotten as they are transformed: move them here where memory is dear.
std::vector<Coefficient> direct_transport(const RadianceSpace& space, std::vector<PairLinks> pairs,
                                          const Progress& progress);

}  // namespace lightwell
