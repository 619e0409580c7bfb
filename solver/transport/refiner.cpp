#include "solver/transport/refiner.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

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

/// Refines the links of one pair of elements.
class PairRefiner {
  public:
    PairRefiner(const std::vector<Element>& elements, const Oracle& oracle, PairLinks& result,
                OracleCost& cost)
        : elements_(elements), oracle_(oracle), result_(result), cost_(cost) {}

    void visit(const Link& link, std::vector<int> occluders) {
        LinkGeometry geometry;
        geometry.link = link;
        geometry.receiver = &elements_[link.receiver.element];
        geometry.sender = &elements_[link.sender.element];
        geometry.receiver_facet.normal = receiver_normal_;
        geometry.sender_facet.normal = sender_normal_;
        geometry.receiver_finest = geometry.receiver->space.tree().is_finest(link.receiver.space);
        geometry.sender_finest = geometry.sender->space.tree().is_finest(link.sender.space);
        if (!face_each_other(geometry)) return;

        LinkStrata strata;
        const Verdict verdict = oracle_.judge(geometry, occluders, strata, cost_);
        if (verdict.act == Verdict::Act::drop) return;
        const unsigned sides =
            verdict.act == Verdict::Act::keep ? kept_strata(geometry) : verdict.sub_domains;
        const std::vector<Support> receivers =
            refined(link.receiver, *geometry.receiver, (sides & receiver_space) != 0,
                    (sides & receiver_angle) != 0);
        const std::vector<Support> senders =
            refined(link.sender, *geometry.sender, (sides & sender_space) != 0,
                    (sides & sender_angle) != 0);
        for (std::size_t i = 0; i < receivers.size(); ++i) {
            for (std::size_t j = 0; j < senders.size(); ++j) {
                if (verdict.act == Verdict::Act::refine)
                    visit({receivers[i], senders[j]}, occluders);
                else if (strata.exchange[i][j] > 0)
                    record(receivers[i], senders[j], strata.exchange[i][j], strata.sampled);
            }
        }
    }

    void set_normals(const Vec3& receiver, const Vec3& sender) {
        receiver_normal_ = receiver;
        sender_normal_ = sender;
    }

  private:
    static unsigned kept_strata(const LinkGeometry& geometry) {
        return (geometry.receiver_finest ? 0U : unsigned{receiver_space}) |
               (geometry.sender_finest ? 0U : unsigned{sender_space});
    }

    void record(const Support& receiver, const Support& sender, double exchange, bool sampled) {
        LinkValue value;
        value.receiver = elements_[receiver.element].space.tree().position(receiver.space);
        value.sender = elements_[sender.element].space.tree().position(sender.space);
        value.exchange = exchange;
        value.sampled = sampled;
        result_.links.push_back(value);
    }

    const std::vector<Element>& elements_;
    const Oracle& oracle_;
    PairLinks& result_;
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

}  // namespace

std::vector<PairLinks> refine_links(const std::vector<Element>& elements,
                                    const std::vector<Quad>& quads, const OccluderTree& tree,
                                    const Oracle& oracle, const Progress& progress,
                                    OracleCost& cost) {
    const std::size_t n = elements.size();
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
    std::atomic<std::size_t> finished{0};
    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
        progress.check();
        for (std::size_t j = i + 1; j < n; ++j) {
            if (buried[i] || buried[j]) continue;
            const Element& x = elements[i];
            const Element& y = elements[j];
            if (!has_part_in_front(x.geometry, normal[j], y.geometry.vertex[0], tolerance[i]) ||
                !has_part_in_front(y.geometry, normal[i], x.geometry.vertex[0], tolerance[j]))
                continue;
            std::vector<int> occluders;
            if (oracle.needs_occluders())
                occluders = occluders_between(x, normal[i], y, normal[j], quads, tree);
            PairLinks pair{static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), {}};
            PairRefiner refiner(elements, oracle, pair, cost_by_receiver[i]);
            refiner.set_normals(normal[i], normal[j]);
            refiner.visit({{pair.receiver, {}, {}}, {pair.sender, {}, {}}}, std::move(occluders));
            if (!pair.links.empty()) by_receiver[i].push_back(std::move(pair));
        }
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
