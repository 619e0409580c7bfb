#include "solver/reference/sampling.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <Eigen/Geometry>

namespace lightwell {

namespace {

/// Radical inverse in base 2: the first Sobol' dimension, 32 bits.
std::uint32_t first_dimension(std::uint32_t index) {
    std::uint32_t result = 0;
    for (std::uint32_t digit = 1U << 31; index != 0; index >>= 1, digit >>= 1)
        if ((index & 1U) != 0) result ^= digit;
    return result;
}

/// The second Sobol' dimension, 32 bits: direction numbers of the primitive polynomial x + 1.
std::uint32_t second_dimension(std::uint32_t index) {
    std::uint32_t result = 0;
    for (std::uint32_t digit = 1U << 31; index != 0; index >>= 1, digit ^= digit >> 1)
        if ((index & 1U) != 0) result ^= digit;
    return result;
}

/// A direction given by its cosine with `axis` and its azimuth.
Vec3 around(const Vec3& axis, double cosine, double azimuth) {
    const Vec3 across = axis.unitOrthogonal();
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return sine * std::cos(azimuth) * across + sine * std::sin(azimuth) * axis.cross(across) +
           cosine * axis;
}

}  // namespace

void draw_even_points(std::vector<Vec2>& points, RandomStream& random) {
    const auto shift_u = static_cast<std::uint32_t>(random.bits() >> 32);
    const auto shift_v = static_cast<std::uint32_t>(random.bits() >> 32);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto index = static_cast<std::uint32_t>(i);
        points[i] = Vec2((first_dimension(index) ^ shift_u) * 0x1p-32,
                         (second_dimension(index) ^ shift_v) * 0x1p-32);
    }
    for (std::size_t i = points.size(); i > 1; --i)
        std::swap(points[i - 1], points[random.below(i)]);
}

Vec3 cosine_direction(const Vec3& normal, const Vec2& square) {
    return around(normal, std::sqrt(1 - square[0]), 2 * M_PI * square[1]);
}

Vec3 cone_direction(const Vec3& axis, double edge_cosine, const Vec2& square) {
    return around(axis, 1 - square[0] * (1 - edge_cosine), 2 * M_PI * square[1]);
}

Vec3 uniform_point_on(const Quad& quad, const Vec2& square) {
    const Vec3& apex = quad.vertex[0];
    const Vec3 sides[3] = {quad.vertex[1] - apex, quad.vertex[2] - apex, quad.vertex[3] - apex};
    const double first_area = sides[0].cross(sides[1]).norm();
    const double first_share = first_area / (first_area + sides[1].cross(sides[2]).norm());
    const bool in_first = square[0] < first_share;
    const double along =
        in_first ? square[0] / first_share : (square[0] - first_share) / (1 - first_share);
    const double from_apex = std::sqrt(along);
    const Vec3& start = in_first ? sides[0] : sides[1];
    const Vec3& end = in_first ? sides[1] : sides[2];
    return apex + from_apex * ((1 - square[1]) * start + square[1] * end);
}

}  // namespace lightwell
