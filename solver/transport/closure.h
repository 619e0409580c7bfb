#pragma once

#include <vector>

#include "radiance4d/progress.h"
#include "solver/transport/link.h"

namespace lightwell {

/// How the closure repair works.
struct ClosureOptions {
    int sweeps = 16;       ///< at most
    double target = 1e-6;  ///< stop when no cell is off by more than this share of its hemisphere
    double most_change =
        2;  ///< no link ends up larger or smaller than it was by more than this factor
};

/// What the repair found and left, as shares of the hemisphere, rms over the cells of closed sides.
struct ClosureReport {
    double deficit_before = 0;
    double deficit_after = 0;
    int sweeps = 0;
};

/// Makes the exchange areas of links that rays sampled add up: from a side that nothing escapes
/// from, the form factors to everything else sum to one at every cell. A closure error delta is
/// amplified to rho delta / (1 - rho (1 + delta)) by interreflection, so it must be far below the
/// error asked for. Exchange areas stay symmetric: each link is scaled by what both of its ends
/// lack, over what they have in sampled links (a symmetric scaling in the manner of Sinkhorn; cf.
/// van Leersum 1989 on enforcing the closure relation). Exact links are left alone.
///
/// @param closed by element: whether nothing escapes from it
/// @throws Interrupted if the progress says so
ClosureReport close_links(const std::vector<Element>& elements, const std::vector<bool>& closed,
                          const ClosureOptions& options, std::vector<PairLinks>& pairs,
                          const Progress& progress = {});

/// Sum of form factors from each finest cell of each element to everything: 1 where nothing
/// escapes.
std::vector<std::vector<double>> row_sums(const std::vector<Element>& elements,
                                          const std::vector<PairLinks>& pairs);

}  // namespace lightwell
