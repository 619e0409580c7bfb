#include "solver/transport/refiner.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "radiance4d/failure.h"
#include "solver/transport/pair_refiner.h"
#include "solver/transport/shaft.h"

namespace lightwell {

namespace {

/// Quads that may stand between two whole elements.
std::vector<int> occluders_between(const Element& x, const Vec3& normal_x, const Element& y,
                                   const Vec3& normal_y, const std::vector<Quad>& quads,
                                   const OccluderTree& tree) {
    std::vector<int> found;
    const Shaft shaft(Facet::of(x.geometry, normal_x), Facet::of(y.geometry, normal_y));
    tree.collect(shaft.region(), x.quad, y.quad, found);
    found.erase(std::remove_if(found.begin(), found.end(),
                               [&](int q) {
                                   return !shaft.may_be_cut_by(quads[static_cast<std::size_t>(q)]);
                               }),
                found.end());
    return found;
}

/// Whether no light reaches any of it: it forms no links.
bool is_buried(const Element& element) {
    return !element.open.empty() && std::all_of(element.open.begin(), element.open.end(),
                                                [](OpenMask mask) { return mask == 0; });
}

bool has_part_in_front(const Quad& quad, const Vec3& n, const Vec3& on_plane, double tolerance) {
    for (const Vec3& corner : quad.vertex)
        if (n.dot(corner - on_plane) > tolerance) return true;
    return false;
}

/// What was decided earlier about a pair; null where nothing was kept.
const PairRecord* record_of(const std::vector<PairRecord>& by_sender, std::uint32_t sender) {
    const auto found = std::lower_bound(
        by_sender.begin(), by_sender.end(), sender,
        [](const PairRecord& record, std::uint32_t wanted) { return record.sender < wanted; });
    return found != by_sender.end() && found->sender == sender ? &*found : nullptr;
}

/// What became of a pair.
struct Decided {
    PairLinks links;
    PairRecord record;
    OracleCost cost;
};

}  // namespace

std::vector<PairLinks> refine_links(const std::vector<Element>& elements,
                                    const std::vector<Quad>& quads, const OccluderTree& tree,
                                    const Oracle& oracle, const Progress& progress,
                                    OracleCost& cost, LinkRecords* records,
                                    const LinkLimits& limits) {
    const std::size_t n = elements.size();
    const bool goes_on = records != nullptr && !records->empty();
    LIGHTWELL_CHECK(!goes_on || records->by_receiver.size() == n);
    std::vector<Vec3> normal(n);
    std::vector<double> tolerance(n);
    std::vector<char> buried(n);
    for (std::size_t e = 0; e < n; ++e) {
        buried[e] = is_buried(elements[e]);
        normal[e] = elements[e].geometry.normal();
        tolerance[e] = coplanar_share * Facet::of(elements[e].geometry, normal[e]).reach();
    }

    std::atomic<std::uint64_t> links{0};
    std::atomic<bool> forgets{records == nullptr};
    const auto count = [&](std::size_t kept) {
        progress.check();
        const std::uint64_t now = links += kept;
        if (now > limits.most) throw TooManyLinks("there are too many links");
        if (now > limits.recorded) forgets = true;
    };
    const auto decided = [&](std::size_t i, std::size_t j, const PairRecord* earlier) {
        const Element& x = elements[i];
        const Element& y = elements[j];
        const PairLinks pair{static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), {}};
        const auto occluders = [&] {
            return oracle.needs_occluders()
                       ? occluders_between(x, normal[i], y, normal[j], quads, tree)
                       : std::vector<int>();
        };
        Decided result;
        PairRefiner refiner(elements, oracle, occluders, pair, normal[i], normal[j], result.cost,
                            count);
        if (earlier != nullptr)
            refiner.go_on_from(*earlier);
        else
            refiner.refine();
        result.links = refiner.take_links();
        result.record = refiner.take_record();
        return result;
    };
    const auto may_see_each_other = [&](std::size_t i, std::size_t j) {
        return !buried[i] && !buried[j] &&
               has_part_in_front(elements[i].geometry, normal[j], elements[j].geometry.vertex[0],
                                 tolerance[i]) &&
               has_part_in_front(elements[j].geometry, normal[i], elements[i].geometry.vertex[0],
                                 tolerance[j]);
    };

    std::vector<std::vector<PairLinks>> by_receiver(n);
    std::vector<OracleCost> cost_by_receiver(n);
    if (records != nullptr) records->by_receiver.resize(n);
    std::atomic<std::size_t> finished{0};
    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
        std::vector<PairRecord> earlier_ones;
        if (goes_on) earlier_ones = std::move(records->by_receiver[i]);
        // Among few elements one may have most of the links: its pairs run in parallel too.
        std::vector<Decided> by_sender(n - i - 1);
        tbb::parallel_for(i + 1, n, [&](std::size_t j) {
            progress.check();
            if (!may_see_each_other(i, j)) return;
            const auto sender = static_cast<std::uint32_t>(j);
            const PairRecord* earlier = goes_on ? record_of(earlier_ones, sender) : nullptr;
            if (goes_on && earlier == nullptr) return;
            by_sender[j - i - 1] = decided(i, j, earlier);
        });
        std::vector<PairRecord> kept;
        for (Decided& pair : by_sender) {
            cost_by_receiver[i].rays += pair.cost.rays;
            cost_by_receiver[i].links_judged += pair.cost.links_judged;
            if (!pair.links.links.empty()) by_receiver[i].push_back(std::move(pair.links));
            if (!forgets && !pair.record.verdicts.empty()) kept.push_back(std::move(pair.record));
        }
        if (records != nullptr) records->by_receiver[i] = std::move(kept);
        progress.say("links", static_cast<double>(++finished) / static_cast<double>(n));
    });

    if (records != nullptr && forgets) records->by_receiver.clear();
    std::vector<PairLinks> all;
    for (std::size_t i = 0; i < n; ++i) {
        for (PairLinks& pair : by_receiver[i])
            all.push_back(std::move(pair));
        cost.rays += cost_by_receiver[i].rays;
        cost.links_judged += cost_by_receiver[i].links_judged;
    }
    return all;
}

}  // namespace lightwell
