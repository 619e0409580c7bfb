#pragma once

#include <cstdint>
#include <vector>

namespace lightwell {

/// What was decided about a link that was kept, enough to tell whether it would be kept again.
struct KeptVerdict {
    double importance = 0;  ///< the share of the scene's light that the link may be wrong by
    int rays = 0;           ///< that visibility was sampled with; 0 where geometry knew it
    bool finest = false;    ///< whether neither of its cells can be refined
};

/// All decisions about the links of one pair of elements, in the order of the visits.
struct PairRecord {
    /// Of a visit: links that are none, or are kept; all others were refined in SubDomains.
    enum Step : std::uint8_t { nothing = 0, kept = 16 };

    std::uint32_t sender = 0;
    std::vector<std::uint8_t> steps;
    std::vector<KeptVerdict> verdicts;  ///< of the kept links
    std::vector<double> exchange;       ///< of the strata of the kept links [m2]
};

/// What a refinement decided, from which one of tighter tolerance can go on: a link that was
/// refined is refined again, one that was kept with room to spare is kept with the values it has,
/// and only what lies between is looked at. The links are those of a refinement from the start, to
/// the last bit, since the rays of a link depend on nothing but the link.
struct LinkRecords {
    /// By receiver, then by sender; pairs without a kept link are left out.
    std::vector<std::vector<PairRecord>> by_receiver;

    bool empty() const { return by_receiver.empty(); }
};

}  // namespace lightwell
