#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/basis/radiance_space.h"

namespace lightwell {

/// The common support of a bundle of basis functions: a spatial cell and an angular cell of one
/// element.
struct Support {
    std::uint32_t element = 0;
    Cell space;
    Cell angle;
};

/// All transfers between the basis functions of two supports: 1 to 256 coefficients (WRT
/// section 4.3).
struct Link {
    Support receiver;
    Support sender;
};

/// The four 2D sub-domains of a link, as bits: each may be refined by itself, which gives 16
/// verdicts.
enum SubDomain : unsigned {
    receiver_space = 1,
    receiver_angle = 2,
    sender_space = 4,
    sender_angle = 8,
};

/// A kept link, or one stratum of it, between two diffuse supports of a known pair of elements.
/// There are up to 10^8 of them: it takes 16 bytes.
struct LinkValue {
    LinkValue(std::uint32_t receiver_cell, std::uint32_t sender_cell, double exchange_area,
              bool by_rays)
        : receiver(receiver_cell),
          sender(sender_cell & 0x7fffffffU),
          sampled(by_rays),
          exchange(exchange_area) {}

    std::uint32_t receiver;     ///< CellTree::position of the receiver's spatial cell
    std::uint32_t sender : 31;  ///< CellTree::position of the sender's spatial cell
    bool sampled : 1;  ///< whether rays decided the visibility, so that the value is an estimate
    double exchange;   ///< exchange area with visibility [m2]
};
static_assert(sizeof(LinkValue) == 16);

/// The links between two elements, receiver < sender; the operator is symmetric, so each unordered
/// pair occurs once.
struct PairLinks {
    std::uint32_t receiver = 0;
    std::uint32_t sender = 0;
    std::vector<LinkValue> links;
};

}  // namespace lightwell
