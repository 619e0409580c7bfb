#include "radiance4d/basis/direction_map.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace lightwell {

namespace {

/// Side of the square that belongs to the first of the two wedges on either axis: |a| > |b|.
Vec2 disk_from_square(double a, double b) {
    if (a == 0 && b == 0) return Vec2::Zero();
    const bool along_a = std::abs(a) > std::abs(b);
    const double radius = along_a ? a : b;
    const double angle = along_a ? (M_PI / 4) * (b / a) : M_PI / 2 - (M_PI / 4) * (a / b);
    return radius * Vec2(std::cos(angle), std::sin(angle));
}

Vec2 square_from_disk(const Vec2& disk) {
    const double radius = disk.norm();
    if (radius == 0) return Vec2::Zero();
    // The octant decides which coordinate of the square carries the radius, and with which sign.
    if (std::abs(disk[0]) > std::abs(disk[1])) {
        const double a = std::copysign(radius, disk[0]);
        return {a, a * std::atan(disk[1] / disk[0]) / (M_PI / 4)};
    }
    const double b = std::copysign(radius, disk[1]);
    return {b * std::atan(disk[0] / disk[1]) / (M_PI / 4), b};
}

}  // namespace

Vec3 direction_from_square(const Vec2& st) {
    const Vec2 disk = disk_from_square(2 * st[0] - 1, 2 * st[1] - 1);
    return {disk[0], disk[1], std::sqrt(std::max(0.0, 1 - disk.squaredNorm()))};
}

Vec2 square_from_direction(const Vec3& direction) {
    const Vec2 ab = square_from_disk(direction.head<2>());
    return (0.5 * (ab.array() + 1)).matrix();
}

Vec3 spiral_direction(int k, int n) {
    const double golden_angle = M_PI * (3 - std::sqrt(5.0));
    const double z = 1 - (2 * k + 1.0) / n;
    const double radius = std::sqrt(1 - z * z);
    return {radius * std::cos(golden_angle * k), radius * std::sin(golden_angle * k), z};
}

Eigen::Matrix3d local_frame(const Quad& quad) {
    Eigen::Matrix3d frame;
    const Vec3 z = quad.normal();
    const Vec3 along = quad.vertex[1] - quad.vertex[0] + quad.vertex[2] - quad.vertex[3];
    const Vec3 x = (along - z.dot(along) * z).normalized();
    frame << x, z.cross(x), z;
    return frame;
}

}  // namespace lightwell
