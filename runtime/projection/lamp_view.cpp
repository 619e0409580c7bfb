#include "runtime/projection/lamp_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace lightwell {

namespace {

constexpr double least_cosine = 0.8;

/// By how much pixels are turned against what they count: edges of shadows are often parallel to
/// the sides of quads, and an edge along a row of pixels hides or shows all of them at once. This
/// slope, 1 / (4 + 1 / golden ratio), spreads the places where an edge crosses pixels evenly.
constexpr double slope = 0.21654;

/// A turn of a square by that slope, so much smaller that it stays within the square.
Eigen::Matrix3d turned_square() {
    const double c = 1 / std::hypot(1, slope), s = slope * c;
    Eigen::Matrix3d turn;
    turn << c / (c + s), -s / (c + s), 0, s / (c + s), c / (c + s), 0, 0, 0, 1;
    return turn;
}

/// A turn in space that leaves no axis, nor any plane of axes, where it was.
Eigen::Matrix3d turned_axes() {
    const double angle = std::atan(slope);
    return (Eigen::AngleAxisd(angle, Vec3::UnitX()) * Eigen::AngleAxisd(angle, Vec3::UnitY()) *
            Eigen::AngleAxisd(angle, Vec3::UnitZ()))
        .toRotationMatrix();
}

}  // namespace

bool LampView::reaches(const Quad& quad) const {
    bool left = true, right = true, below = true, above = true, behind = true;
    for (const Vec3& corner : quad.vertex) {
        const Vec3 at = seen * corner;
        left = left && at[0] < -at[2];
        right = right && at[0] > at[2];
        below = below && at[1] < -at[2];
        above = above && at[1] > at[2];
        behind = behind && at[2] < 0;
    }
    return !(left || right || below || above || behind);
}

std::array<LampView, 6> cube_views() {
    std::array<LampView, 6> views;
    const Eigen::Matrix3d turn = turned_axes();
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        Eigen::Matrix3d& seen = views[static_cast<std::size_t>(face)].seen;
        seen.setZero();
        seen(0, (axis + 1) % 3) = 1;
        seen(1, (axis + 2) % 3) = 1;
        seen(2, axis) = face % 2 == 0 ? 1 : -1;
        seen *= turn;
    }
    return views;
}

std::optional<LampView> close_view(const Quad& quad, double margin) {
    std::array<Vec3, 4> towards;
    Vec3 forward = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
        towards[k] = quad.vertex[k].normalized();
        forward += towards[k];
    }
    forward.normalize();
    for (const Vec3& direction : towards)
        if (!(direction.dot(forward) >= least_cosine)) return std::nullopt;

    const Vec3 side = quad.vertex[1] - quad.vertex[0];
    Vec3 right = quad.normal().cross(forward);
    if (right.norm() < 0.1) right = side - side.dot(forward) * forward;
    right.normalize();
    const Vec3 up = forward.cross(right);
    const double infinity = std::numeric_limits<double>::infinity();
    Vec2 low(infinity, infinity), high = -low;
    for (const Vec3& direction : towards) {
        const Vec2 at = Vec2(right.dot(direction), up.dot(direction)) / forward.dot(direction);
        low = low.cwiseMin(at);
        high = high.cwiseMax(at);
    }
    const Vec2 middle = 0.5 * (low + high), half = (0.5 + margin) * (high - low);
    if (!(half.minCoeff() > 0)) return std::nullopt;
    LampView view;
    view.seen << (right - middle[0] * forward).transpose() / half[0],
        (up - middle[1] * forward).transpose() / half[1], forward.transpose();
    view.seen = turned_square() * view.seen;
    return view;
}

}  // namespace lightwell
