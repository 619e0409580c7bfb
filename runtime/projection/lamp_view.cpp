#include "runtime/projection/lamp_view.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

namespace lightwell {

namespace {

constexpr double least_cosine = 0.8;

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
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        Eigen::Matrix3d& seen = views[static_cast<std::size_t>(face)].seen;
        seen.setZero();
        seen(0, (axis + 1) % 3) = 1;
        seen(1, (axis + 2) % 3) = 1;
        seen(2, axis) = face % 2 == 0 ? 1 : -1;
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
    return view;
}

}  // namespace lightwell
