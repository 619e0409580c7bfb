#include "runtime/drawing/camera_rays.h"

#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace lightwell {

namespace {

constexpr double pi = 3.14159265358979323846;

std::string in_words(const Vec3& v) {
    return fmt::format("({:g}, {:g}, {:g})", v[0], v[1], v[2]);
}

/// Unit vector along `vector`, which only rounding may have kept from being zero at the scale
/// given.
Vec3 unit(const Vec3& vector, double scale, const std::string& complaint) {
    constexpr double rounding = 1e-12;
    const double length = vector.norm();
    if (!(length > rounding * scale) || !std::isfinite(length)) throw InputError(complaint);
    return vector / length;
}

}  // namespace

CameraRays::CameraRays(const Camera& camera, int width, int height)
    : width_(width), height_(height), position_(camera.position) {
    LIGHTWELL_CHECK_OP(width, >, 0);
    LIGHTWELL_CHECK_OP(height, >, 0);
    if (!(camera.vertical_angle > 0 && camera.vertical_angle < 180))
        throw InputError(fmt::format(
            "the camera's vertical angle is {:g} degrees; it must lie between 0 and 180",
            camera.vertical_angle));
    focal_length_ = 0.5 * height / std::tan(camera.vertical_angle * pi / 360);
    forward_ =
        unit(camera.target - camera.position,
             camera.target.cwiseAbs().maxCoeff() + camera.position.cwiseAbs().maxCoeff(),
             fmt::format("the camera at {} looks at its own position", in_words(camera.position)));
    right_ = unit(forward_.cross(camera.up), camera.up.norm(),
                  fmt::format("the camera's up {} is zero or runs along its axis {}",
                              in_words(camera.up), in_words(forward_)));
    top_ = right_.cross(forward_);
}

Eigen::Matrix3d CameraRays::frame() const {
    Eigen::Matrix3d rows;
    rows << right_.transpose(), top_.transpose(), forward_.transpose();
    return rows;
}

Vec3 CameraRays::direction(double x, double y) const {
    return (forward_ + (x - 0.5 * width_) / focal_length_ * right_ -
            (y - 0.5 * height_) / focal_length_ * top_)
        .normalized();
}

Vec3 CameraRays::in_camera(const Vec3& point) const {
    const Vec3 from = point - position_;
    return Vec3(from.dot(right_), from.dot(top_), from.dot(forward_));
}

Vec2 CameraRays::project(const Vec3& point) const {
    const Vec3 seen = in_camera(point);
    return Vec2(0.5 * width_ + focal_length_ * seen[0] / seen[2],
                0.5 * height_ - focal_length_ * seen[1] / seen[2]);
}

}  // namespace lightwell
