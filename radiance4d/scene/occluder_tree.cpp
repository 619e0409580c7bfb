#include "radiance4d/scene/occluder_tree.h"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

namespace lightwell {

namespace {

constexpr int largest_leaf = 4;
constexpr int bin_count = 16;
/// No path from the root is longer, however uneven the scene: where the tree would grow deeper than
/// a balanced one, it is cut at the median.
constexpr int stack_size = 128;

Eigen::AlignedBox3d bounds(const Quad& quad) {
    Eigen::AlignedBox3d box;
    for (const Vec3& vertex : quad.vertex)
        box.extend(vertex);
    return box;
}

double surface(const Eigen::AlignedBox3d& box) {
    if (box.isEmpty()) return 0;
    const Vec3 d = box.sizes();
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

/// Where to divide a set of quads: those whose centre along `axis` falls into a bin below `bin`.
struct Division {
    int axis = 0;
    int bin = 0;  ///< 0: no division separates anything
    double low = 0;
    double bins_per_metre = 0;

    bool is_below(const Vec3& centre) const {
        return std::min(bin_count - 1, static_cast<int>((centre[axis] - low) * bins_per_metre)) <
               bin;
    }
};

/// The division of least surface-area cost along one axis, with that cost (MacDonald and Booth
/// 1990), by bins (Wald 2007).
template <typename Entries>
std::pair<double, Division> best_along(int axis, const Entries& begin, const Entries& end,
                                       const Eigen::AlignedBox3d& centres) {
    std::pair<double, Division> best{std::numeric_limits<double>::infinity(), Division()};
    const double width = centres.sizes()[axis];
    if (!(width > 0)) return best;
    Division division{axis, 0, centres.min()[axis], bin_count / width};

    std::array<Eigen::AlignedBox3d, bin_count> box;
    std::array<int, bin_count> count{};
    for (auto entry = begin; entry != end; ++entry) {
        const double place = entry->quad.centre()[axis] - division.low;
        const int in = std::min(bin_count - 1, static_cast<int>(place * division.bins_per_metre));
        box[static_cast<std::size_t>(in)].extend(bounds(entry->quad));
        ++count[static_cast<std::size_t>(in)];
    }
    std::array<double, bin_count> cost{};
    Eigen::AlignedBox3d below, above;
    int count_below = 0, count_above = 0;
    for (std::size_t k = 1; k < bin_count; ++k) {
        below.extend(box[k - 1]);
        count_below += count[k - 1];
        cost[k] += surface(below) * count_below;
        above.extend(box[bin_count - k]);
        count_above += count[bin_count - k];
        cost[bin_count - k] += surface(above) * count_above;
    }
    for (int k = 1; k < bin_count; ++k)
        if (cost[static_cast<std::size_t>(k)] < best.first) {
            division.bin = k;
            best = {cost[static_cast<std::size_t>(k)], division};
        }
    return best;
}

}  // namespace

OccluderTree::OccluderTree(const std::vector<Quad>& quads) {
    entries_.reserve(quads.size());
    for (const Quad& quad : quads)
        entries_.push_back({quad, static_cast<int>(entries_.size())});
    nodes_.reserve(quads.size());
    if (!quads.empty()) build(0, static_cast<int>(quads.size()));
}

void OccluderTree::build(int first, int count) {
    const auto begin = entries_.begin() + first, end = begin + count;
    Eigen::AlignedBox3d box, centres;
    for (auto entry = begin; entry != end; ++entry) {
        box.extend(bounds(entry->quad));
        centres.extend(entry->quad.centre());
    }
    const auto self = nodes_.size();
    nodes_.push_back({box, 0, first, count});
    if (count <= largest_leaf) return;

    Division division;
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const auto [cost, candidate] = best_along(axis, begin, end, centres);
        if (cost < least) std::tie(least, division) = std::tie(cost, candidate);
    }
    auto middle = std::stable_partition(
        begin, end, [&](const Entry& entry) { return division.is_below(entry.quad.centre()); });
    // An uneven cut would make the tree deep, none (all centres the same) endless.
    const auto smaller = std::min(middle - begin, end - middle);
    if (division.bin == 0 || 16 * smaller < count) {
        int axis = 0;
        centres.sizes().maxCoeff(&axis);
        middle = begin + count / 2;
        std::nth_element(begin, middle, end, [&](const Entry& a, const Entry& b) {
            const double at_a = a.quad.centre()[axis], at_b = b.quad.centre()[axis];
            return at_a != at_b ? at_a < at_b : a.index < b.index;
        });
    }
    const int below = static_cast<int>(middle - begin);
    nodes_[self].count = 0;
    build(first, below);
    nodes_[self].second_child = static_cast<int>(nodes_.size());
    build(first + below, count - below);
}

void OccluderTree::collect(const ConvexRegion& region, std::vector<int>& found) const {
    collect(region, -1, -1, found);
}

void OccluderTree::collect(const ConvexRegion& region, int not_this, int nor_this,
                           std::vector<int>& found) const {
    found.clear();
    if (nodes_.empty()) return;
    std::array<int, stack_size> waiting;
    int depth = 0;
    waiting[static_cast<std::size_t>(depth++)] = 0;
    while (depth > 0) {
        const int at = waiting[static_cast<std::size_t>(--depth)];
        const Node& node = nodes_[static_cast<std::size_t>(at)];
        if (region.misses(node.box)) continue;
        if (node.count == 0) {
            LIGHTWELL_CHECK_OP(depth + 2, <=, stack_size);
            waiting[static_cast<std::size_t>(depth++)] = node.second_child;
            waiting[static_cast<std::size_t>(depth++)] = at + 1;
            continue;
        }
        for (int k = node.first; k < node.first + node.count; ++k) {
            const Entry& entry = entries_[static_cast<std::size_t>(k)];
            if (entry.index != not_this && entry.index != nor_this && !region.misses(entry.quad))
                found.push_back(entry.index);
        }
    }
    std::sort(found.begin(), found.end());
}

}  // namespace lightwell
