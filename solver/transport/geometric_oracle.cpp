#include "solver/transport/geometric_oracle.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solver/transport/kernel.h"
#include "solver/transport/kernel_samples.h"
#include "solver/transport/shaft.h"

namespace lightwell {

namespace {

/// Sides of a link whose sizes are within this factor are refined together.
constexpr double similar_size = 1.6;

/// Most that the rays of a finest link are multiplied by.
constexpr double most_excess = 4;

/// Lengths below this share of the smaller facet's reach are not told apart when visibility is
/// weighed.
constexpr double softening_share = 0.7;

/// Refines the larger support, or both where they are of similar size; what is finest stays.
unsigned refine_by_size(const LinkGeometry& link, double receiver_reach, double sender_reach) {
    if (link.receiver_finest) return sender_space;
    if (link.sender_finest) return receiver_space;
    if (receiver_reach > similar_size * sender_reach) return receiver_space;
    if (sender_reach > similar_size * receiver_reach) return sender_space;
    return receiver_space | sender_space;
}

/// Refines the sides that explain a third or more of the variance, at least the one that explains
/// most.
unsigned refine_by_variance(const LinkGeometry& link, const KernelVariation& variation) {
    if (link.receiver_finest) return sender_space;
    if (link.sender_finest) return receiver_space;
    const double third = variation.variance / 3;
    unsigned sides = 0;
    if (variation.receiver_variance >= third) sides |= receiver_space;
    if (variation.sender_variance >= third) sides |= sender_space;
    return sides != 0 ? sides : receiver_space | sender_space;
}

/// Areas of the children's parts in front of the other side's plane, or what they are alike in if
/// these are too narrow to have any.
std::array<double, 4> areas_in_front(const Element& element, const std::array<Cell, 4>& children,
                                     int count, const Facet& own, const Facet& other) {
    std::array<double, 4> area{};
    for (int i = 0; i < count; ++i) {
        const Facet whole = Facet::of(element.cell(children[i]), own.normal);
        area[i] = whole.in_front_of(other.normal, other.normal.dot(other[0]), 0).area();
    }
    if (!(*std::max_element(area.begin(), area.end()) > 0)) area.fill(1);
    return area;
}

/// Shares the exact exchange area of the whole link among its strata: by the kernel over all of
/// each, times the open share of each, times the share of that which is seen.
void share(double whole, const LinkGeometry& link, const LinkChildren& children,
           const std::array<std::array<double, 4>, 4>& kernel,
           const std::array<std::array<double, 4>, 4>& seen, LinkStrata& strata) {
    // Where the samples add up to less than this share of the whole, they looked away, to rounding.
    constexpr double said_nothing = 1e-6;
    double sum = 0;
    std::array<double, 4> area_x{}, area_y{};
    for (int i = 0; i < children.receivers; ++i)
        area_x[i] = link.receiver->cell(children.receiver[i]).area();
    for (int j = 0; j < children.senders; ++j)
        area_y[j] = link.sender->cell(children.sender[j]).area();
    for (int i = 0; i < children.receivers; ++i)
        for (int j = 0; j < children.senders; ++j)
            sum += kernel[i][j] * area_x[i] * area_y[j];
    const bool by_kernel = sum > said_nothing * whole;
    // Else their exchange is spread over what is in front.
    double in_front_x = 0, in_front_y = 0;
    if (!by_kernel) {
        area_x = areas_in_front(*link.receiver, children.receiver, children.receivers,
                                link.receiver_facet, link.sender_facet);
        area_y = areas_in_front(*link.sender, children.sender, children.senders, link.sender_facet,
                                link.receiver_facet);
        in_front_x = std::accumulate(area_x.begin(), area_x.begin() + children.receivers, 0.0);
        in_front_y = std::accumulate(area_y.begin(), area_y.begin() + children.senders, 0.0);
    }
    const OpenShares open = open_shares(link, children);
    for (int i = 0; i < children.receivers; ++i) {
        for (int j = 0; j < children.senders; ++j) {
            const double part = area_x[i] * area_y[j] *
                                (by_kernel ? kernel[i][j] / sum : 1 / (in_front_x * in_front_y));
            strata.exchange[i][j] = whole * part * open.receiver[i] * open.sender[j] * seen[i][j];
        }
    }
}

/// Leaves those of the occluders that may stand in the shaft.
void leave_those_that_cut(const Shaft& shaft, const std::vector<Quad>& quads,
                          std::vector<int>& occluders) {
    const auto misses = [&](int q) {
        return !shaft.may_be_cut_by(quads[static_cast<std::size_t>(q)]);
    };
    occluders.erase(std::remove_if(occluders.begin(), occluders.end(), misses), occluders.end());
}

}  // namespace

GeometricOracle::GeometricOracle(const GeometricOracleOptions& options,
                                 const std::vector<Quad>& quads, const Visibility& visibility,
                                 double scene_area)
    : options_(options), quads_(quads), visibility_(visibility), scene_area_(scene_area) {}

void GeometricOracle::strike_out(const LinkGeometry& link, std::vector<int>& occluders) const {
    if (occluders.empty()) return;
    const Shaft shaft(link.receiver_facet, link.sender_facet);
    leave_those_that_cut(shaft, quads_, occluders);
}

bool GeometricOracle::keeps(const KeptVerdict& earlier) const {
    const bool partial = earlier.rays > 0;
    const double allowed = partial ? options_.partial_tolerance : options_.tolerance;
    if (!earlier.finest && !(earlier.importance < allowed)) return false;
    return !partial || rays_for(earlier.importance) == earlier.rays;
}

int GeometricOracle::rays_for(double importance) const {
    const double excess =
        std::clamp(importance / std::max(options_.partial_tolerance, 1e-300), 1.0, most_excess);
    return static_cast<int>(std::lround(options_.rays * excess));
}

Verdict GeometricOracle::judge(const LinkGeometry& link, std::vector<int>& occluders,
                               LinkStrata& strata, OracleCost& cost) const {
    ++cost.links_judged;

    // Who stands between?
    if (!occluders.empty()) {
        const Shaft shaft(link.receiver_facet, link.sender_facet);
        leave_those_that_cut(shaft, quads_, occluders);
        for (const int q : occluders)
            if (shaft.is_covered_by(quads_[static_cast<std::size_t>(q)])) return {};
    }
    const bool partial = !occluders.empty();

    // How much does the kernel vary?
    const LinkChildren children = children_of(link);
    const KernelVariation variation = kernel_variation(link, children);
    const double area_x = link.receiver->space.area(link.link.receiver.space);
    const double area_y = link.sender->space.area(link.link.sender.space);
    const double deviation = partial ? std::max(std::sqrt(variation.variance), 0.5 * variation.mean)
                                     : std::sqrt(variation.variance);
    const double importance =
        deviation * std::sqrt(area_x * area_y * std::max(area_x, area_y) / scene_area_);
    const double allowed = partial ? options_.partial_tolerance : options_.tolerance;
    const bool finest = link.receiver_finest && link.sender_finest;
    if (!finest) {
        const double reach_x = link.receiver_facet.reach(), reach_y = link.sender_facet.reach();
        const double distance = (link.sender_facet.centre() - link.receiver_facet.centre()).norm();
        const bool near = distance < options_.near_ratio * (reach_x + reach_y);
        if (near || !(importance < allowed))
            return {Verdict::Act::refine,
                    near || partial ? refine_by_size(link, reach_x, reach_y)
                                    : refine_by_variance(link, variation),
                    {}};
    }

    // Keep it: exact exchange where all is clear, times the visible share seen by rays where it is
    // not.
    const double whole = exchange_area(link.receiver_facet, link.sender_facet);
    if (!partial) {
        std::array<std::array<double, 4>, 4> all_seen{};
        for (auto& row : all_seen)
            row.fill(1);
        share(whole, link, children, variation.value, all_seen, strata);
        return {Verdict::Act::keep, 0, {importance, 0, finest}};
    }
    const int rays = rays_for(importance);
    const int strata_count = children.receivers * children.senders;
    const double softening =
        softening_share * std::min(link.receiver_facet.reach(), link.sender_facet.reach());
    const StratifiedSamples samples = sample_strata(
        link, children, (rays + strata_count - 1) / strata_count, softening, visibility_, cost);
    if (samples.highest > 0) share(whole, link, children, samples.kernel, samples.seen, strata);
    strata.sampled = true;
    return {Verdict::Act::keep, 0, {importance, rays, finest}};
}

}  // namespace lightwell
