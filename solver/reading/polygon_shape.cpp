#include "solver/reading/polygon_shape.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

namespace lightwell {

namespace {

constexpr double pi = 3.14159265358979323846;

Vec3 mean(const Outline& outline) {
    // Relative to the first corner: outlines far from the origin lose no digits.
    Vec3 sum = Vec3::Zero();
    for (const Vec3& corner : outline)
        sum += corner - outline.front();
    return outline.front() + sum / static_cast<double>(outline.size());
}

/// Height of the triangle over its longest side; 0 if all three points are one.
double height(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    return longest > 0 ? (b - a).cross(c - a).norm() / longest : 0;
}

/// Whether segments ab and cd cross at inner points of both.
bool cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

}  // namespace

double diameter(const Outline& outline) {
    double largest = 0;
    for (std::size_t i = 0; i < outline.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            largest = std::max(largest, (outline[i] - outline[j]).squaredNorm());
    return std::sqrt(largest);
}

Vec3 vector_area(const Outline& outline) {
    Vec3 doubled = Vec3::Zero();
    for (std::size_t i = 2; i < outline.size(); ++i)
        doubled += (outline[i - 1] - outline[0]).cross(outline[i] - outline[0]);
    return 0.5 * doubled;
}

double out_of_plane(const Outline& outline) {
    const Vec3 middle = mean(outline);
    const Vec3 normal = vector_area(outline).normalized();
    double farthest = 0;
    for (const Vec3& corner : outline)
        farthest = std::max(farthest, std::abs(normal.dot(corner - middle)));
    return farthest;
}

Outline flattened(const Outline& outline) {
    const Vec3 middle = mean(outline);
    const Vec3 normal = vector_area(outline).normalized();
    Outline flat;
    for (const Vec3& corner : outline)
        flat.push_back(corner - normal.dot(corner - middle) * normal);
    return flat;
}

std::vector<int> shaping_corners(const Outline& outline, double tolerance) {
    std::vector<int> kept(outline.size());
    std::iota(kept.begin(), kept.end(), 0);
    // One corner at a time, against the neighbours that are left then; after a corner goes, the one
    // before it is judged again. Done when a whole round removes nothing.
    std::size_t at = 0, unchanged = 0;
    while (kept.size() >= 3 && unchanged < kept.size()) {
        const std::size_t n = kept.size();
        const auto corner = [&](std::size_t i) {
            return outline[static_cast<std::size_t>(kept[i % n])];
        };
        if (height(corner(at + n - 1), corner(at), corner(at + 1)) <= tolerance) {
            kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(at % n));
            at = (at + n - 1) % n;
            if (at >= kept.size()) at = 0;
            unchanged = 0;
        } else {
            at = (at + 1) % n;
            ++unchanged;
        }
    }
    return kept;
}

std::vector<Vec2> in_mean_plane(const Outline& outline) {
    const Vec3 normal = vector_area(outline).normalized();
    int smallest = 0;
    normal.cwiseAbs().minCoeff(&smallest);
    const Vec3 x = normal.cross(Vec3::Unit(smallest)).normalized();
    const Vec3 y = normal.cross(x);
    std::vector<Vec2> flat;
    for (const Vec3& corner : outline) {
        const Vec3 offset = corner - outline.front();
        flat.emplace_back(x.dot(offset), y.dot(offset));
    }
    return flat;
}

bool is_convex(const std::vector<Vec2>& outline) {
    const std::size_t n = outline.size();
    double turning = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 before = outline[(i + 1) % n] - outline[i];
        const Vec2 after = outline[(i + 2) % n] - outline[(i + 1) % n];
        const double cross = before[0] * after[1] - before[1] * after[0];
        if (!(cross > 0)) return false;
        turning += std::atan2(cross, before.dot(after));
    }
    // Stars turn left everywhere, too, but go round more than once.
    return turning < 3 * pi;
}

bool crosses_itself(const std::vector<Vec2>& outline) {
    const std::size_t n = outline.size();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 2; j < n; ++j)
            if (cross(outline[i], outline[i + 1], outline[j], outline[(j + 1) % n])) return true;
    return false;
}

}  // namespace lightwell
