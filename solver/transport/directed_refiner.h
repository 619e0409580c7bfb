#pragma once

#include <vector>

#include "radiance4d/progress.h"
#include "radiance4d/scene/visibility.h"
#include "solver/transport/directed_links.h"
#include "solver/transport/directional_oracle.h"
#include "solver/transport/oracle.h"

namespace lightwell {

struct DirectedRefinerOptions {
    /// Pairs of points that tell a kept link's directions, for each angular cell that it spans
    /// along either axis, squared; >= 1.
    int points = 8;
};

/// Carries out the verdicts of the directional oracle on links in space: the four sub-domains of a
/// link are refined adaptively, where directed_links goes to the finest cells everywhere. What a
/// link carries is divided among its parts by the kernel at evenly spread pairs of points, and each
/// pair of points knows the angular cells that its ends see each other through (angular_shares): a
/// part whose angular cells do not point at the other end gets nothing, and no part is visited
/// twice, because the parts are disjoint. Rays are cast only for links of partial visibility. Sums
/// over directions are those of the given links.
///
/// @param given   links in space between all elements, as refine_links finds and close_links
///                closes them; those between sides without angular cells are taken over
/// @param detail  by element
std::vector<DirectedPair> refine_directions(const std::vector<Element>& elements,
                                            const std::vector<AngularDetail>& detail,
                                            const std::vector<PairLinks>& given,
                                            const DirectionalOracle& oracle,
                                            const Visibility& visibility,
                                            const DirectedRefinerOptions& options,
                                            const Progress& progress, OracleCost& cost);

}  // namespace lightwell
