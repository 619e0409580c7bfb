#include "radiance4d/scene/shadow.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace lightwell {

namespace {

/// Rounding error of a point's coordinates, relative to the largest: the point, the quad's vertices
/// and the difference have each been rounded a few times.
constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();

/// A piece of this many vertices is halved before it is cut by up to five planes.
constexpr int many_vertices = ConvexPolygon::capacity - 5;

double highest(const ConvexPolygon& piece, const Plane& plane) {
    double height = -std::numeric_limits<double>::infinity();
    for (const Vec3& vertex : piece)
        height = std::max(height, plane.height(vertex));
    return height;
}

double lowest(const ConvexPolygon& piece, const Plane& plane) {
    double height = std::numeric_limits<double>::infinity();
    for (const Vec3& vertex : piece)
        height = std::min(height, plane.height(vertex));
    return height;
}

}  // namespace

Shadow::Shadow(const Vec3& x, const Quad& occluder) : apex_(x) {
    double largest = x.cwiseAbs().maxCoeff();
    std::array<Vec3, 4> corner;
    for (std::size_t k = 0; k < 4; ++k) {
        corner[k] = occluder.vertex[k] - x;
        largest = std::max(largest, occluder.vertex[k].cwiseAbs().maxCoeff());
    }

    const Vec3 doubled_area = (corner[2] - corner[0]).cross(corner[3] - corner[1]);
    const double length = doubled_area.norm();
    if (!(length > 0)) return;
    const Vec3 normal = doubled_area / length;
    const Vec3 centre = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]);
    const double height = normal.dot(centre);
    if (std::abs(height) <= rounding * largest) return;
    const double side = height < 0 ? -1 : 1;

    behind_ = {side * normal, std::abs(height)};
    breadth_ = 0.5 * length * std::abs(height) / std::pow(centre.norm(), 3);
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 &from = corner[k], &to = corner[(k + 1) % 4];
        // Twice from x to, without its cancellation, and with all signs turned exactly when two
        // quads run along their shared edge in opposite directions: their shadows then meet.
        const Vec3 across = (from + to).cross(to - from);
        const double across_length = across.norm();
        if (across_length > 0)
            edges_[static_cast<std::size_t>(edge_count_++)] = {side / across_length * across, 0};
    }
}

bool Shadow::misses(const ConvexPolygon& piece, double sliver, double contact) const {
    if (highest(piece, behind_) <= contact) return true;
    return std::any_of(edges_.begin(), edges_.begin() + edge_count_,
                       [&](const Plane& edge) { return highest(piece, edge) <= sliver; });
}

bool Shadow::covers(const ConvexPolygon& piece, double contact) const {
    return !empty() && lowest(piece, behind_) > contact &&
           std::all_of(edges_.begin(), edges_.begin() + edge_count_,
                       [&](const Plane& edge) { return lowest(piece, edge) >= 0; });
}

void Shadow::subtract_from(std::vector<ConvexPolygon>& pieces, double sliver,
                           double contact) const {
    if (empty()) return;
    std::vector<ConvexPolygon> seen;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        if (misses(pieces[p], sliver, contact)) {
            seen.push_back(pieces[p]);
            continue;
        }
        if (pieces[p].size() > many_vertices) {
            // Grows the list that is being walked through: the halves come up later.
            const auto [first, second] = halved(pieces[p]);
            pieces.push_back(first);
            pieces.push_back(second);
            continue;
        }
        const std::size_t seen_before = seen.size();
        CutPolygon rest = cut(pieces[p], behind_, sliver);
        if (!rest.outside.empty()) seen.push_back(rest.outside);
        for (int k = 0; k < edge_count_ && !rest.inside.empty(); ++k) {
            rest = cut(rest.inside, edges_[static_cast<std::size_t>(k)], sliver);
            if (!rest.outside.empty()) seen.push_back(rest.outside);
        }
        // Nothing was in shadow after all: one piece is better than its fragments.
        if (rest.inside.empty()) {
            seen.resize(seen_before);
            seen.push_back(pieces[p]);
        }
    }
    pieces.swap(seen);
}

}  // namespace lightwell
