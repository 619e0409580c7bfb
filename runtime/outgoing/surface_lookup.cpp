#include "runtime/outgoing/surface_lookup.h"

#include <cmath>

#include <Eigen/Geometry>

namespace lightwell {

namespace {

constexpr double relative_tolerance = 1e-5;
/// Cosine of one degree.
constexpr double parallel_cosine = 0.99984769515639127;

/// Whether a point of the quad's plane lies in its outline, widened by `tolerance` [m].
bool in_outline(const Quad& quad, const Vec3& normal, const Vec3& point, double tolerance) {
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 edge = quad.vertex[(k + 1) % 4] - quad.vertex[k];
        const Vec3 inwards = normal.cross(edge);
        if (inwards.dot(point - quad.vertex[k]) < -tolerance * edge.norm()) return false;
    }
    return true;
}

}  // namespace

SurfaceLookup::SurfaceLookup(const std::vector<Quad>& quads, const OccluderTree& occluders)
    : quads_(quads), occluders_(occluders) {
    Eigen::AlignedBox3d box;
    for (const Quad& quad : quads)
        for (const Vec3& vertex : quad.vertex)
            box.extend(vertex);
    if (!box.isEmpty()) tolerance_ = relative_tolerance * box.diagonal().norm();
}

SensorStand SurfaceLookup::stand(const Vec3& point, const Vec3& normal) const {
    const Vec3 reach = Vec3::Constant(2 * tolerance_);
    std::vector<int> candidates;
    occluders_.collect(ConvexRegion(Eigen::AlignedBox3d(point - reach, point + reach)), candidates);

    SensorStand stand;
    stand.point = point;
    double nearest = tolerance_;
    for (const int candidate : candidates) {
        const Quad& quad = quads_[static_cast<std::size_t>(candidate)];
        const Vec3 up = quad.normal();
        const double height = up.dot(point - quad.vertex[0]);
        if (!(std::abs(height) <= nearest) || !in_outline(quad, up, point, tolerance_)) continue;
        const double cosine = normal.dot(up);
        if (std::abs(cosine) < parallel_cosine) continue;
        nearest = std::abs(height);
        stand = {point - height * up, candidate, cosine > 0};
    }
    if (stand.quad != free_point) return stand;

    for (const int candidate : candidates) {
        const Quad& quad = quads_[static_cast<std::size_t>(candidate)];
        const Vec3 up = quad.normal();
        const double height = up.dot(stand.point - quad.vertex[0]);
        if (!(std::abs(height) < tolerance_) || !in_outline(quad, up, point, tolerance_)) continue;
        stand.point += (std::copysign(tolerance_, normal.dot(up)) - height) * up;
    }
    return stand;
}

}  // namespace lightwell
