#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/progress.h"
#include "radiance4d/scene/visibility.h"
#include "solver/transport/link.h"
#include "solver/transport/oracle.h"

namespace lightwell {

/// A link with the directions through which its ends see each other.
struct DirectedLink {
    std::uint32_t receiver = 0;        ///< CellTree::position of the receiver's spatial cell
    std::uint32_t receiver_angle = 0;  ///< of the angular cell that points to the sender
    std::uint32_t sender = 0;          ///< as above, of the sender
    std::uint32_t sender_angle = 0;    ///< of the angular cell that points to the receiver
    double exchange = 0;               ///< exchange area of these supports [m2]
    bool sampled = false;              ///< whether rays decided it
};

/// The directed links between two elements, receiver < sender. They are symmetric: what arrives at
/// x from a direction left y by the opposite one, so that either end may send.
struct DirectedPair {
    std::uint32_t receiver = 0;
    std::uint32_t sender = 0;
    std::vector<DirectedLink> links;
};

struct DirectedLinkOptions {
    /// Rays from each pair of a finest spatial and a finest angular cell; at least 1.
    int rays = 24;
};

/// The links that carry direction. Between elements without angular functions they are the given
/// ones. Wherever an end has angular functions, an angular cell is tied to where the other end
/// lies: rays from the finest spatial cells X through the finest angular cells A find the cell Y
/// that is met, and the angular cell B of Y by which they arrive. Every ray carries the same part
/// of |X| |A|, the exchange of X with everything through A, so that all directions are full (A
/// measured by its share of the angular square); rays that escape carry nothing. Where both ends
/// have angular functions, rays from either end count by half. Given links between such elements
/// are not used.
std::vector<DirectedPair> directed_links(const std::vector<Element>& elements,
                                         const std::vector<PairLinks>& given,
                                         const Visibility& visibility,
                                         const DirectedLinkOptions& options,
                                         const Progress& progress, OracleCost& cost);

/// Scales the sampled links so that what is known adds up: through the angular cell A of a spatial
/// cell X that nothing escapes from, the exchange with everything is |X| |A|. The links stay
/// symmetric, each scaled by what both of its ends lack (Sinkhorn), by no more than a factor of
/// two.
///
/// @param closed by element: whether nothing escapes from it
/// @return what was missing or too much before, as a share, root mean square over the area and
/// directions of closed elements
double close_directions(const std::vector<Element>& elements, const std::vector<bool>& closed,
                        std::vector<DirectedPair>& pairs);

}  // namespace lightwell
