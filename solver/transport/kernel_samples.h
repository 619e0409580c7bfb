#pragma once

#include <array>

#include "radiance4d/scene/visibility.h"
#include "solver/transport/oracle.h"

namespace lightwell {

/// The children of the two supports of a link, which are the strata that its kernel is looked at
/// in. A finest cell is its own only child.
struct LinkChildren {
    std::array<Cell, 4> receiver;
    std::array<Cell, 4> sender;
    int receivers = 1;
    int senders = 1;
};

LinkChildren children_of(const LinkGeometry& link);

/// The kernel F at the pairs of child centres [1/m2], without visibility, and how it varies over
/// them.
struct KernelVariation {
    std::array<std::array<double, 4>, 4> value{};
    double mean = 0;
    double variance = 0;  ///< over all pairs
    double receiver_variance =
        0;  ///< of the means over the sender: what refining the receiver would resolve
    double sender_variance = 0;  ///< of the means over the receiver
};

KernelVariation kernel_variation(const LinkGeometry& link, const LinkChildren& children);

/// Shares of the strata in front of the other side's plane that are open (see OpenMask): 1 where
/// nothing is buried.
struct OpenShares {
    std::array<double, 4> receiver{};
    std::array<double, 4> sender{};
};

OpenShares open_shares(const LinkGeometry& link, const LinkChildren& children);

/// Quasi-random samples of the kernel and of visibility in each stratum.
struct StratifiedSamples {
    std::array<std::array<double, 4>, 4> kernel{};  ///< mean of F over a stratum [1/m2]
    std::array<std::array<double, 4>, 4>
        seen{};          ///< Int F V / Int F over what of it is open and in front, in [0,1]
    double lowest = 0;   ///< of F V over all samples
    double highest = 0;  ///< of F V over all samples
};

/// Draws `per_stratum` samples in every stratum, where it is open and in front of the other side,
/// and traces a ray for each that faces: what is buried needs no ray, and no chance decides how
/// much of it there is. The sequence is fixed by the link, so results do not depend on who computes
/// them when.
StratifiedSamples sample_strata(const LinkGeometry& link, const LinkChildren& children,
                                int per_stratum, double softening, const Visibility& visibility,
                                OracleCost& cost);

}  // namespace lightwell
