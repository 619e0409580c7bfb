#include "solver/reference/polygon_factor.h"

#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

namespace lightwell {

namespace {

/// The part of a quad above the plane through the origin, corners relative to the origin: at most
/// five corners.
struct Clipped {
    std::array<Vec3, 5> corner;
    std::size_t count = 0;
};

Clipped above_horizon(const Vec3& origin, const Vec3& normal, const Quad& quad) {
    Clipped result;
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 here = quad.vertex[k] - origin;
        const Vec3 next = quad.vertex[(k + 1) % 4] - origin;
        const double height = normal.dot(here), next_height = normal.dot(next);
        if (height >= 0) result.corner[result.count++] = here;
        if ((height > 0 && next_height < 0) || (height < 0 && next_height > 0))
            result.corner[result.count++] = here + height / (height - next_height) * (next - here);
    }
    return result;
}

}  // namespace

double point_to_quad_factor(const Vec3& point, const Vec3& normal, const Quad& quad) {
    const Clipped polygon = above_horizon(point, normal, quad);
    double sum = 0;
    for (std::size_t k = 0; k < polygon.count; ++k) {
        const Vec3& a = polygon.corner[k];
        const Vec3& b = polygon.corner[(k + 1) % polygon.count];
        const Vec3 across = a.cross(b);
        const double sine = across.norm();
        if (sine > 0) sum += normal.dot(across) / sine * std::atan2(sine, a.dot(b));
    }
    return std::abs(sum) / (2 * M_PI);
}

}  // namespace lightwell
