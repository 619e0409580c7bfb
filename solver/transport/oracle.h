#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/transport/facet.h"
#include "solver/transport/link.h"
#include "solver/transport/link_records.h"

namespace lightwell {

/// What to do with a link.
struct Verdict {
    enum class Act { drop, keep, refine };
    Act act = Act::drop;
    unsigned sub_domains = 0;  ///< which SubDomains to refine
    KeptVerdict kept;          ///< where it is kept
};

/// A link with the geometry that judging it needs.
struct LinkGeometry {
    Link link;
    const Element* receiver = nullptr;
    const Element* sender = nullptr;
    Facet receiver_facet;  ///< part of the receiver's cell in front of the sender's plane
    Facet sender_facet;    ///< part of the sender's cell in front of the receiver's plane
    bool receiver_finest = false;
    bool sender_finest = false;
};

/// Values of a kept link, by strata: the receiver's children times the sender's, or the cells
/// themselves where they are finest.
struct LinkStrata {
    std::array<std::array<double, 4>, 4>
        exchange{};  ///< [receiver child][sender child], visibility included [m2]
    bool sampled = false;
};

/// Counts what an oracle spends.
struct OracleCost {
    std::uint64_t rays = 0;
    std::uint64_t links_judged = 0;
};

/// Decides which links to refine, and puts values to those it keeps. It only decides: the refiner
/// carries out. Oracles are immutable and shared by threads.
class Oracle {
  public:
    virtual ~Oracle() = default;

    /// Judges a link. `occluders` holds the quads that may stand between the two supports; the
    /// oracle may strike out those that cannot, for the benefit of the children. Where the verdict
    /// is keep, `strata` receives the values.
    virtual Verdict judge(const LinkGeometry& link, std::vector<int>& occluders, LinkStrata& strata,
                          OracleCost& cost) const = 0;
    /// Whether `occluders` are looked at; without need they are not collected.
    virtual bool needs_occluders() const = 0;
    /// Strikes out the occluders that judge would strike out before it refines the link.
    virtual void strike_out(const LinkGeometry& /*link*/, std::vector<int>& /*occluders*/) const {}
    /// Whether a link that an oracle of this kind, but no tighter tolerance, kept would be kept by
    /// this one with the same values. Only oracles that refine whatever looser ones refine may say
    /// so.
    virtual bool keeps(const KeptVerdict& /*earlier*/) const { return false; }
};

}  // namespace lightwell
