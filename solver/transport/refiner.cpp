#include "solver/transport/refiner.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <optional>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "radiance4d/failure.h"
#include "solver/transport/kernel_samples.h"
#include "solver/transport/shaft.h"

namespace lightwell {

namespace {

/// Heights below this share of a facet's size do not count as in front: they are rounding.
constexpr double coplanar_share = 1e-9;

/// Sets the facets of a link: what each support shows to the other. False where they do not face at
/// all.
bool face_each_other(LinkGeometry& link) {
    const Quad x = link.receiver->cell(link.link.receiver.space);
    const Quad y = link.sender->cell(link.link.sender.space);
    const Facet whole_x = Facet::of(x, link.receiver_facet.normal);
    const Facet whole_y = Facet::of(y, link.sender_facet.normal);
    const double tolerance = coplanar_share * (whole_x.reach() + whole_y.reach());
    link.receiver_facet =
        whole_x.in_front_of(whole_y.normal, whole_y.normal.dot(y.vertex[0]), tolerance);
    if (link.receiver_facet.empty()) return false;
    link.sender_facet =
        whole_y.in_front_of(whole_x.normal, whole_x.normal.dot(x.vertex[0]), tolerance);
    return !link.sender_facet.empty();
}

/// The supports that one end of a link is refined into: children in space, in angle, in both or in
/// neither.
std::vector<Support> refined(const Support& support, const Element& element, bool in_space,
                             bool in_angle) {
    std::vector<Support> result = {support};
    const auto split = [&result](const CellTree& tree, Cell Support::*part) {
        std::vector<Support> finer;
        for (const Support& coarse : result) {
            for (std::uint32_t c = 0; c < tree.children((coarse.*part).level); ++c) {
                Support child = coarse;
                child.*part = tree.child(coarse.*part, c);
                finer.push_back(child);
            }
        }
        result = std::move(finer);
    };
    if (in_space) split(element.space.tree(), &Support::space);
    if (in_angle) split(element.angle, &Support::angle);
    return result;
}

/// Steps through a record in the order of its visits.
class RecordReader {
  public:
    explicit RecordReader(const PairRecord& record) : record_(record) {}

    std::uint8_t next_step() { return record_.steps[step_++]; }
    const KeptVerdict& next_verdict() { return record_.verdicts[verdict_++]; }
    double next_exchange() { return record_.exchange[exchange_++]; }

  private:
    const PairRecord& record_;
    std::size_t step_ = 0, verdict_ = 0, exchange_ = 0;
};

/// Refines the links of one pair of elements.
class PairRefiner {
  public:
    /// @param root  collects the quads that may stand between the whole elements
    PairRefiner(const std::vector<Element>& elements, const Oracle& oracle,
                std::function<std::vector<int>()> root, const PairLinks& pair, OracleCost& cost)
        : elements_(elements), oracle_(oracle), root_(std::move(root)), cost_(cost) {
        result_.receiver = pair.receiver;
        result_.sender = pair.sender;
        record_.sender = pair.sender;
    }

    void set_normals(const Vec3& receiver, const Vec3& sender) {
        receiver_normal_ = receiver;
        sender_normal_ = sender;
    }

    void refine() { visit(whole(), root_()); }

    /// The same from what was decided earlier.
    void go_on_from(const PairRecord& earlier) {
        RecordReader reader(earlier);
        revisit(whole(), nullptr, reader);
    }

    PairLinks take_links() { return std::move(result_); }
    PairRecord take_record() {
        record_.steps.shrink_to_fit();
        record_.verdicts.shrink_to_fit();
        record_.exchange.shrink_to_fit();
        return std::move(record_);
    }

  private:
    /// A link that was refined, with those of the occluders that stand in its way, found when they
    /// are asked for.
    struct Refined {
        Refined* parent = nullptr;
        LinkGeometry geometry;
        std::optional<std::vector<int>> occluders;
    };

    Link whole() const { return {{result_.receiver, {}, {}}, {result_.sender, {}, {}}}; }

    LinkGeometry geometry_of(const Link& link) const {
        LinkGeometry geometry;
        geometry.link = link;
        geometry.receiver = &elements_[link.receiver.element];
        geometry.sender = &elements_[link.sender.element];
        geometry.receiver_facet.normal = receiver_normal_;
        geometry.sender_facet.normal = sender_normal_;
        geometry.receiver_finest = geometry.receiver->space.tree().is_finest(link.receiver.space);
        geometry.sender_finest = geometry.sender->space.tree().is_finest(link.sender.space);
        return geometry;
    }

    void visit(const Link& link, std::vector<int> occluders) {
        LinkGeometry geometry = geometry_of(link);
        LinkStrata strata;
        Verdict verdict;
        if (face_each_other(geometry)) verdict = oracle_.judge(geometry, occluders, strata, cost_);
        switch (verdict.act) {
            case Verdict::Act::drop:
                record_.steps.push_back(PairRecord::nothing);
                return;
            case Verdict::Act::keep:
                keep(geometry, verdict.kept, strata);
                return;
            case Verdict::Act::refine:
                record_.steps.push_back(static_cast<std::uint8_t>(verdict.sub_domains));
                for_each_child(geometry, verdict.sub_domains,
                               [&](const Link& child) { visit(child, occluders); });
                return;
        }
    }

    void revisit(const Link& link, Refined* parent, RecordReader& earlier) {
        const std::uint8_t step = earlier.next_step();
        if (step == PairRecord::nothing) {
            record_.steps.push_back(step);
            return;
        }
        Refined here{parent, geometry_of(link), {}};
        if (step != PairRecord::kept) {
            record_.steps.push_back(step);
            for_each_child(here.geometry, step,
                           [&](const Link& child) { revisit(child, &here, earlier); });
            return;
        }
        const KeptVerdict& verdict = earlier.next_verdict();
        LinkStrata strata;
        strata.sampled = verdict.rays > 0;
        const LinkChildren children = children_of(here.geometry);
        for (int i = 0; i < children.receivers; ++i)
            for (int j = 0; j < children.senders; ++j)
                strata.exchange[i][j] = earlier.next_exchange();
        if (oracle_.keeps(verdict))
            keep(here.geometry, verdict, strata);
        else
            visit(link, parent != nullptr ? occluders_of(*parent) : root_());
    }

    const std::vector<int>& occluders_of(Refined& link) {
        if (!link.occluders) {
            link.occluders = link.parent != nullptr ? occluders_of(*link.parent) : root_();
            face_each_other(link.geometry);
            oracle_.strike_out(link.geometry, *link.occluders);
        }
        return *link.occluders;
    }

    template <class Act>
    void for_each_child(const LinkGeometry& geometry, unsigned sides, const Act& act) const {
        const std::vector<Support> senders =
            refined(geometry.link.sender, *geometry.sender, (sides & sender_space) != 0,
                    (sides & sender_angle) != 0);
        for (const Support& receiver :
             refined(geometry.link.receiver, *geometry.receiver, (sides & receiver_space) != 0,
                     (sides & receiver_angle) != 0))
            for (const Support& sender : senders)
                act({receiver, sender});
    }

    void keep(const LinkGeometry& geometry, const KeptVerdict& verdict, const LinkStrata& strata) {
        record_.steps.push_back(PairRecord::kept);
        record_.verdicts.push_back(verdict);
        const LinkChildren children = children_of(geometry);
        for (int i = 0; i < children.receivers; ++i) {
            for (int j = 0; j < children.senders; ++j) {
                const double exchange = strata.exchange[i][j];
                record_.exchange.push_back(exchange);
                if (!(exchange > 0)) continue;
                LinkValue value;
                value.receiver = geometry.receiver->space.tree().position(children.receiver[i]);
                value.sender = geometry.sender->space.tree().position(children.sender[j]);
                value.exchange = exchange;
                value.sampled = strata.sampled;
                result_.links.push_back(value);
            }
        }
    }

    const std::vector<Element>& elements_;
    const Oracle& oracle_;
    std::function<std::vector<int>()> root_;
    PairLinks result_;
    PairRecord record_;
    OracleCost& cost_;
    Vec3 receiver_normal_ = Vec3::Zero();
    Vec3 sender_normal_ = Vec3::Zero();
};

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

}  // namespace

std::vector<PairLinks> refine_links(const std::vector<Element>& elements,
                                    const std::vector<Quad>& quads, const OccluderTree& tree,
                                    const Oracle& oracle, const Progress& progress,
                                    OracleCost& cost, LinkRecords* records) {
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

    std::vector<std::vector<PairLinks>> by_receiver(n);
    std::vector<OracleCost> cost_by_receiver(n);
    if (records != nullptr) records->by_receiver.resize(n);
    std::atomic<std::size_t> finished{0};
    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
        progress.check();
        std::vector<PairRecord> earlier_ones, decided;
        if (goes_on) earlier_ones = std::move(records->by_receiver[i]);
        for (std::size_t j = i + 1; j < n; ++j) {
            if (buried[i] || buried[j]) continue;
            const Element& x = elements[i];
            const Element& y = elements[j];
            if (!has_part_in_front(x.geometry, normal[j], y.geometry.vertex[0], tolerance[i]) ||
                !has_part_in_front(y.geometry, normal[i], x.geometry.vertex[0], tolerance[j]))
                continue;
            const PairLinks pair{static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), {}};
            const PairRecord* earlier = goes_on ? record_of(earlier_ones, pair.sender) : nullptr;
            if (goes_on && earlier == nullptr) continue;
            const auto occluders = [&] {
                return oracle.needs_occluders()
                           ? occluders_between(x, normal[i], y, normal[j], quads, tree)
                           : std::vector<int>();
            };
            PairRefiner refiner(elements, oracle, occluders, pair, cost_by_receiver[i]);
            refiner.set_normals(normal[i], normal[j]);
            if (earlier != nullptr)
                refiner.go_on_from(*earlier);
            else
                refiner.refine();
            PairRecord record = refiner.take_record();
            if (records != nullptr && !record.verdicts.empty())
                decided.push_back(std::move(record));
            PairLinks links = refiner.take_links();
            if (!links.links.empty()) by_receiver[i].push_back(std::move(links));
        }
        if (records != nullptr) records->by_receiver[i] = std::move(decided);
        progress.say("links", static_cast<double>(++finished) / static_cast<double>(n));
    });

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
