#include "solver/reading/triangle_pairing.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include <Eigen/Geometry>

#include "solver/reading/polygon_shape.h"

namespace lightwell {

namespace {

/// A side of a triangle, filed under its two vertices in ascending order.
struct Side {
    int low, high;
    int triangle;
    int opposite;    ///< the vertex that is not on the side
    bool ascending;  ///< whether the triangle runs along it from low to high

    bool operator<(const Side& other) const {
        return std::tie(low, high, triangle, ascending) <
               std::tie(other.low, other.high, other.triangle, other.ascending);
    }
};

struct Candidate {
    long long rank;  ///< -1e6 times the worst corner's sine
    TrianglePair pair;

    bool operator<(const Candidate& other) const {
        return std::tie(rank, pair.first, pair.second) <
               std::tie(other.rank, other.pair.first, other.pair.second);
    }
};

std::vector<Side> sorted_sides(const std::vector<Triangle>& triangles) {
    std::vector<Side> sides;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& v = triangles[t].vertex;
            const int from = v[i], to = v[(i + 1) % 3], opposite = v[(i + 2) % 3];
            sides.push_back(
                {std::min(from, to), std::max(from, to), static_cast<int>(t), opposite, from < to});
        }
    std::sort(sides.begin(), sides.end());
    return sides;
}

/// The sine of the worst corner if the outline is a planar, strictly convex quad.
std::optional<double> worst_corner(const Outline& outline, const PairingRule& rule) {
    const double size = diameter(outline);
    const Vec3 normal = vector_area(outline).normalized();
    if (out_of_plane(outline) > rule.planarity * size) return std::nullopt;
    double worst = 1;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 before = outline[(i + 1) % 4] - outline[i];
        const Vec3 after = outline[(i + 2) % 4] - outline[(i + 1) % 4];
        const double cross = normal.dot(before.cross(after));
        const double across = (before + after).norm();
        if (!(cross > rule.convexity * size * across)) return std::nullopt;
        worst = std::min(worst, cross / (before.norm() * after.norm()));
    }
    return worst;
}

std::optional<Candidate> candidate(const std::vector<Vec3>& vertices,
                                   const std::vector<Triangle>& triangles, const Side& a,
                                   const Side& b, const PairingRule& rule) {
    const auto material = [&](const Side& side) {
        return triangles[static_cast<std::size_t>(side.triangle)].material;
    };
    if (a.triangle == b.triangle || a.ascending == b.ascending || material(a) != material(b))
        return std::nullopt;
    const Side& up = a.ascending ? a : b;
    const Side& down = a.ascending ? b : a;
    const std::array<int, 4> corners = {up.low, down.opposite, up.high, up.opposite};
    Outline outline;
    for (const int corner : corners)
        outline.push_back(vertices[static_cast<std::size_t>(corner)]);
    const auto worst = worst_corner(outline, rule);
    if (!worst) return std::nullopt;
    return Candidate{-std::llround(1e6 * *worst),
                     {std::min(a.triangle, b.triangle), std::max(a.triangle, b.triangle), corners}};
}

std::vector<Candidate> sorted_candidates(const std::vector<Vec3>& vertices,
                                         const std::vector<Triangle>& triangles,
                                         const PairingRule& rule) {
    // A side of more triangles than this is no surface but damage; to try all pairs there would
    // take time that grows with the square of their number.
    constexpr std::ptrdiff_t most_at_a_side = 16;
    std::vector<Candidate> candidates;
    const std::vector<Side> sides = sorted_sides(triangles);
    for (auto begin = sides.begin(); begin != sides.end();) {
        const auto end = std::find_if(begin, sides.end(), [&](const Side& side) {
            return side.low != begin->low || side.high != begin->high;
        });
        if (end - begin <= most_at_a_side)
            for (auto a = begin; a != end; ++a)
                for (auto b = a + 1; b != end; ++b)
                    if (const auto found = candidate(vertices, triangles, *a, *b, rule))
                        candidates.push_back(*found);
        begin = end;
    }
    std::sort(candidates.begin(), candidates.end());
    return candidates;
}

}  // namespace

std::vector<TrianglePair> pair_triangles(const std::vector<Vec3>& vertices,
                                         const std::vector<Triangle>& triangles,
                                         const PairingRule& rule) {
    std::vector<TrianglePair> pairs;
    std::vector<bool> used(triangles.size(), false);
    for (const Candidate& next : sorted_candidates(vertices, triangles, rule)) {
        const auto first = static_cast<std::size_t>(next.pair.first);
        const auto second = static_cast<std::size_t>(next.pair.second);
        if (used[first] || used[second]) continue;
        used[first] = used[second] = true;
        pairs.push_back(next.pair);
    }
    return pairs;
}

}  // namespace lightwell
