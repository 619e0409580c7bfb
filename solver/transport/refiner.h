#pragma once

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "radiance4d/progress.h"
#include "radiance4d/scene/occluder_tree.h"
#include "solver/transport/oracle.h"

namespace lightwell {

/// How many links there may be.
struct LinkLimits {
    std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    /// Up to so many, what was decided is kept to go on from.
    std::uint64_t recorded = std::numeric_limits<std::uint64_t>::max();
};

/// There are more links than there may be.
class TooManyLinks : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Carries out the verdicts of an oracle on every pair of elements: links start at whole quads and
/// are refined in the sub-domains that the oracle names, until it keeps or drops them (WRT
/// section 4.3). Kept links are recorded by their strata. Pairs are independent and run in
/// parallel; the result does not depend on the number of threads.
///
/// @param quads    the scene's quads, by Element::quad: who may stand between
/// @param tree     over the same quads
/// @param records  not empty: what was decided for the same elements by the same kind of oracle, of
///                 no tighter tolerance, to go on from. They receive what is decided now, or
///                 nothing where there are more links than are recorded, and are of no use after
///                 an exception
/// @return the links of all pairs that have any, ordered by receiver, then sender
/// @throws TooManyLinks  as soon as there are more
/// @throws Interrupted   if the progress says so
std::vector<PairLinks> refine_links(const std::vector<Element>& elements,
                                    const std::vector<Quad>& quads, const OccluderTree& tree,
                                    const Oracle& oracle, const Progress& progress,
                                    OracleCost& cost, LinkRecords* records = nullptr,
                                    const LinkLimits& limits = {});

}  // namespace lightwell
