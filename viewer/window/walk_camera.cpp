#include "viewer/window/walk_camera.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace lightwell {

namespace {

constexpr double steepest = 89.5;  // [degrees]
constexpr double degree = M_PI / 180;

}  // namespace

WalkCamera::WalkCamera(const Camera& camera, const Vec3& up)
    : up_(up.normalized()), position_(camera.position), vertical_angle_(camera.vertical_angle) {
    int least = 0;
    up_.cwiseAbs().minCoeff(&least);
    north_ = up_.cross(Vec3::Unit(least)).normalized();
    east_ = north_.cross(up_);

    const Vec3 forward = (camera.target - camera.position).normalized();
    pitch_ = std::asin(std::clamp(forward.dot(up_), -1.0, 1.0)) / degree;
    // Looking straight up or down, the top of the picture says where north is.
    const bool level = std::abs(pitch_) < steepest;
    const Vec3 ahead = level ? forward : Vec3(pitch_ < 0 ? camera.up : Vec3(-camera.up));
    if (std::hypot(ahead.dot(east_), ahead.dot(north_)) > 0)
        yaw_ = std::atan2(ahead.dot(east_), ahead.dot(north_)) / degree;
    pitch_ = std::clamp(pitch_, -steepest, steepest);
}

Camera WalkCamera::camera() const {
    Camera camera;
    camera.position = position_;
    camera.target = position_ + forward();
    camera.up = up_;
    camera.vertical_angle = vertical_angle_;
    return camera;
}

Vec3 WalkCamera::forward() const {
    const double yaw = yaw_ * degree, pitch = pitch_ * degree;
    return std::cos(pitch) * (std::sin(yaw) * east_ + std::cos(yaw) * north_) +
           std::sin(pitch) * up_;
}

Vec3 WalkCamera::right() const {
    const double yaw = yaw_ * degree;
    return std::cos(yaw) * east_ - std::sin(yaw) * north_;
}

void WalkCamera::set_vertical_angle(double degrees) {
    vertical_angle_ = std::clamp(degrees, 5.0, 120.0);
}

void WalkCamera::look(double right, double up) {
    yaw_ = std::remainder(yaw_ + right, 360.0);
    pitch_ = std::clamp(pitch_ + up, -steepest, steepest);
}

void WalkCamera::walk(const WalkDirection& direction, double seconds, const Walls* walls) {
    Vec3 way = direction.forward * forward() + direction.right * right() + direction.up * up_;
    // Two keys at a time must not be faster than one.
    if (way.norm() > 1) way.normalize();
    if (way.isZero()) return;
    const Vec3 to = position_ + speed_ * seconds * way;
    position_ = walls ? walls->walk(position_, to) : to;
}

void WalkCamera::set_speed(double speed) {
    speed_ = std::clamp(speed, 0.01, 1000.0);
}

}  // namespace lightwell
