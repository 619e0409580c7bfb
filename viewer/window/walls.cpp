#include "viewer/window/walls.h"

#include <algorithm>
#include <cmath>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

Vec3 nearest_on_segment(const Vec3& a, const Vec3& b, const Vec3& point) {
    const Vec3 along = b - a;
    const double t = std::clamp((point - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return a + t * along;
}

}  // namespace

Vec3 nearest_on(const Quad& quad, const Vec3& point) {
    const Vec3 normal = quad.normal();
    const Vec3 foot = point - (point - quad.vertex[0]).dot(normal) * normal;
    bool inside = true;
    for (std::size_t k = 0; k < 4 && inside; ++k) {
        const Vec3& a = quad.vertex[k];
        const Vec3& b = quad.vertex[(k + 1) % 4];
        inside = (b - a).cross(foot - a).dot(normal) >= 0;
    }
    if (inside) return foot;

    Vec3 nearest = quad.vertex[0];
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 candidate = nearest_on_segment(quad.vertex[k], quad.vertex[(k + 1) % 4], point);
        if ((candidate - point).squaredNorm() < (nearest - point).squaredNorm())
            nearest = candidate;
    }
    return nearest;
}

Walls::Walls(const std::vector<Quad>& quads, double radius) : radius_(radius) {
    LIGHTWELL_CHECK_OP(radius, >, 0);
    walls_.reserve(quads.size());
    for (const Quad& quad : quads) {
        Eigen::AlignedBox3d reach;
        for (const Vec3& vertex : quad.vertex)
            reach.extend(vertex);
        reach.min().array() -= radius;
        reach.max().array() += radius;
        walls_.push_back({quad, reach});
    }
}

Vec3 Walls::walk(const Vec3& from, const Vec3& to) const {
    // Half a radius at a time: a sphere that moves no farther cannot get its centre past a quad.
    const double distance = (to - from).norm();
    const int steps = std::max(1, static_cast<int>(std::ceil(2 * distance / radius_)));
    Vec3 centre = from;
    for (int k = 0; k < steps; ++k) {
        Vec3 next = centre + (to - from) / steps;
        if (!push_out(next)) return centre;
        centre = next;
    }
    return centre;
}

/// @return whether the sphere touches nothing afterwards.
bool Walls::push_out(Vec3& centre) const {
    constexpr int rounds = 8;
    const double enough = radius_ * (1 - 1e-6);
    for (int round = 0; round < rounds; ++round) {
        bool touched = false;
        for (const Wall& wall : walls_) {
            if (!wall.reach.contains(centre)) continue;
            const Vec3 away = centre - nearest_on(wall.quad, centre);
            const double distance = away.norm();
            if (distance >= enough) continue;
            // In the very plane no side is the right one.
            if (!(distance > 0)) return false;
            centre += (radius_ - distance) / distance * away;
            touched = true;
        }
        if (!touched) return true;
    }
    return false;
}

double walker_radius(const std::vector<Quad>& quads) {
    constexpr double shoulder = 0.2, share = 0.02;
    Eigen::AlignedBox3d box;
    for (const Quad& quad : quads)
        for (const Vec3& vertex : quad.vertex)
            box.extend(vertex);
    return std::min(shoulder, share * box.diagonal().norm());
}

}  // namespace lightwell
