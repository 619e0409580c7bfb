#include "solver/transport/shaft.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lightwell {

namespace {

/// Lowest and highest n.v over the vertices.
void extent(const ConvexPolygon& polygon, const Vec3& n, double& lowest, double& highest) {
    for (const Vec3& vertex : polygon) {
        const double height = n.dot(vertex);
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    }
}

Eigen::AlignedBox3d bounds_of(const Facet& x, const Facet& y) {
    Eigen::AlignedBox3d box;
    for (const Vec3& vertex : x)
        box.extend(vertex);
    for (const Vec3& vertex : y)
        box.extend(vertex);
    return box;
}

}  // namespace

Shaft::Shaft(const Facet& x, const Facet& y) : x_(x), y_(y), region_(bounds_of(x, y)) {
    const double size = region_.box().sizes().maxCoeff();
    tolerance_ = 1e-9 * size;

    // Rays leave to the front of both facets.
    region_.cut({x.normal, x.normal.dot(x[0])});
    region_.cut({y.normal, y.normal.dot(y[0])});

    // Sides of the hull: planes through an edge of one facet and a vertex of the other with both
    // facets on one side. A hull of two facets of up to eight vertices has no more sides than the
    // region holds planes; a plane found twice, by way of two coplanar vertices, only counts once.
    int sides = 2;
    const auto add_sides = [&](const Facet& a, const Facet& b) {
        for (int i = 0; i < a.size(); ++i) {
            const Vec3& start = a[i];
            const Vec3 edge = a.after(i) - start;
            for (int j = 0; j < b.size(); ++j) {
                Vec3 n = edge.cross(b[j] - start);
                const double length = n.norm();
                if (!(length > 1e-12 * edge.norm() * size)) continue;
                n /= length;
                const double d = n.dot(start);
                double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
                extent(a, n, lowest, highest);
                // The facet's own plane, met again by way of a vertex in it, is no side of the
                // hull.
                if (lowest >= d - tolerance_ && highest <= d + tolerance_) continue;
                extent(b, n, lowest, highest);
                const bool below = highest <= d + tolerance_, above = lowest >= d - tolerance_;
                if ((!below && !above) || sides == ConvexRegion::capacity) continue;
                region_.cut(below ? Plane{-n, -d} : Plane{n, d});
                ++sides;
                break;  // one supporting plane an edge
            }
        }
    };
    add_sides(x, y);
    add_sides(y, x);
}

bool Shaft::may_be_cut_by(const Quad& quad) const {
    if (region_.misses(quad)) return false;
    // A quad whose plane has both facets on one side stands beside every ray, at most touching its
    // ends.
    const Vec3 n = quad.normal();
    const double d = n.dot(quad.vertex[0]);
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    extent(x_, n, lowest, highest);
    extent(y_, n, lowest, highest);
    if (!(lowest < d - tolerance_ && highest > d + tolerance_)) return false;
    // What is left of it inside. A quad that only touches the shaft is in nobody's way, however its
    // corners were rounded.
    ConvexPolygon inside(quad);
    for (int k = 0; k < region_.planes() && inside.size() < ConvexPolygon::capacity; ++k) {
        inside = clipped(inside, region_.plane(k), tolerance_);
        if (inside.empty()) return false;
    }
    return true;
}

bool Shaft::is_covered_by(const Quad& quad) const {
    // The quad's plane must part the facets, which may touch it; then the shaft's section with that
    // plane is the hull of the points where the segments between vertices cross it, and a convex
    // quad that holds all of them holds the section.
    const Vec3 n = quad.normal();
    const double d = n.dot(quad.vertex[0]);
    double low_x = std::numeric_limits<double>::infinity(), high_x = -low_x;
    double low_y = low_x, high_y = high_x;
    extent(x_, n, low_x, high_x);
    extent(y_, n, low_y, high_y);
    const double below = d - tolerance_, above = d + tolerance_;
    const bool x_behind = low_x < below && high_x <= above && low_y >= below && high_y > above;
    const bool y_behind = low_y < below && high_y <= above && low_x >= below && high_x > above;
    if (!x_behind && !y_behind) return false;
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 inward = n.cross(quad.vertex[(k + 1) % 4] - quad.vertex[k]).normalized();
        const double bound = inward.dot(quad.vertex[k]) - tolerance_;
        const auto is_inside = [&](const Vec3& point) { return inward.dot(point) >= bound; };
        for (int i = 0; i < x_.size(); ++i) {
            for (int j = 0; j < y_.size(); ++j) {
                const Vec3 &p = x_[i], &q = y_[j];
                const double from = n.dot(p) - d, to = n.dot(q) - d;
                // A segment in the plane crosses it everywhere.
                const bool along = std::abs(from) <= tolerance_ && std::abs(to) <= tolerance_;
                if (along ? !(is_inside(p) && is_inside(q))
                          : !is_inside(p + std::clamp(from / (from - to), 0.0, 1.0) * (q - p)))
                    return false;
            }
        }
    }
    return true;
}

}  // namespace lightwell
