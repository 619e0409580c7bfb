#include "radiance4d/scene/convex_region.h"

#include <algorithm>

namespace lightwell {

bool ConvexRegion::misses(const Quad& quad) const {
    for (int axis = 0; axis < 3; ++axis) {
        const auto& v = quad.vertex;
        const double low = std::min({v[0][axis], v[1][axis], v[2][axis], v[3][axis]});
        const double high = std::max({v[0][axis], v[1][axis], v[2][axis], v[3][axis]});
        if (high <= box_.min()[axis] || low >= box_.max()[axis]) return true;
    }
    return std::any_of(planes_.begin(), planes_.begin() + count_, [&](const Plane& plane) {
        return std::all_of(quad.vertex.begin(), quad.vertex.end(),
                           [&](const Vec3& vertex) { return plane.height(vertex) <= 0; });
    });
}

bool ConvexRegion::misses(const Eigen::AlignedBox3d& other) const {
    if ((other.max().array() <= box_.min().array()).any() ||
        (other.min().array() >= box_.max().array()).any())
        return true;
    return std::any_of(planes_.begin(), planes_.begin() + count_, [&](const Plane& plane) {
        const Vec3 innermost =
            (plane.normal.array() > 0).select(other.max().array(), other.min().array());
        return plane.height(innermost) <= 0;
    });
}

ConvexRegion region_between(const Vec3& x, const ConvexPolygon& polygon) {
    Eigen::AlignedBox3d box(x);
    for (const Vec3& vertex : polygon)
        box.extend(vertex);
    ConvexRegion region(box);

    // Normals point inwards if x sees the polygon counter-clockwise; turn them if not.
    const Vec3 area = polygon.vector_area();
    const double side = area.dot(x - polygon.centre()) < 0 ? -1 : 1;
    for (int i = 0; i < polygon.size(); ++i) {
        const Vec3 across = (polygon[i] - x).cross(polygon.after(i) - polygon[i]);
        const double length = across.norm();
        if (!(length > 0)) continue;
        const Vec3 normal = -side / length * across;
        region.cut({normal, normal.dot(x)});
    }
    if (area.norm() > 0) {
        const Vec3 normal = side * area.normalized();
        region.cut({normal, normal.dot(polygon.centre())});
    }
    return region;
}

}  // namespace lightwell
