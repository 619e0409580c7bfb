#include "viewer/window/handles.h"

#include <algorithm>
#include <cmath>

#include "radiance4d/failure.h"
#include "viewer/window/light_edits.h"

namespace lightwell {

namespace {

constexpr double length_pixels = 60;  // of axes and aim
constexpr double grasp_pixels = 8;    // how near the cursor must be

/// The length [m] that appears as the handles' at the light's distance; 0 behind the eye.
double handle_length(const CameraRays& camera, const Vec3& position) {
    return length_pixels * std::max(0.0, camera.in_camera(position)[2]) / camera.focal_length();
}

std::optional<Vec2> seen(const CameraRays& camera, const Vec3& point) {
    const double nearest = 1e-6 * (1 + point.norm());
    if (!(camera.in_camera(point)[2] > nearest)) return std::nullopt;
    return camera.project(point);
}

Vec3 aim_of(const CameraRays& camera, const SpotLight& spot) {
    return spot.position + 1.5 * handle_length(camera, spot.position) * spot.direction;
}

double distance_to_segment(const Vec2& point, const Vec2& a, const Vec2& b) {
    const Vec2 along = b - a;
    const double squared = along.squaredNorm();
    const double t = squared > 0 ? std::clamp((point - a).dot(along) / squared, 0.0, 1.0) : 0;
    return (a + t * along - point).norm();
}

bool near(const std::optional<Vec2>& place, const Vec2& cursor) {
    return place && (*place - cursor).norm() <= grasp_pixels;
}

constexpr Handle axes[] = {Handle::x, Handle::y, Handle::z};

}  // namespace

HandlePlaces handle_places(const CameraRays& camera, const Light& light) {
    const Vec3& position = position_of(light);
    const double length = handle_length(camera, position);
    HandlePlaces places;
    places.centre = seen(camera, position);
    if (!places.centre) return places;
    for (int k = 0; k < 3; ++k)
        places.axis[static_cast<std::size_t>(k)] = seen(camera, position + length * Vec3::Unit(k));
    if (const auto* spot = std::get_if<SpotLight>(&light))
        places.aim = seen(camera, aim_of(camera, *spot));
    return places;
}

Handle handle_at(const HandlePlaces& places, const Vec2& cursor) {
    if (!places.centre) return Handle::none;
    if (near(places.centre, cursor)) return Handle::centre;
    if (near(places.aim, cursor)) return Handle::aim;
    Handle nearest = Handle::none;
    double least = grasp_pixels;
    for (std::size_t k = 0; k < 3; ++k) {
        if (!places.axis[k]) continue;
        const double distance = distance_to_segment(cursor, *places.centre, *places.axis[k]);
        // An axis that points at the eye is a dot and cannot be told from the centre.
        const bool is_seen = (*places.axis[k] - *places.centre).norm() > grasp_pixels;
        if (!is_seen || distance > least) continue;
        least = distance;
        nearest = axes[k];
    }
    return nearest;
}

HandleDrag::HandleDrag(const CameraRays& camera, const Light& light, Handle handle,
                       const Vec2& cursor)
    : camera_(camera),
      start_(light),
      light_(light),
      handle_(handle),
      facing_(camera.direction(0.5 * camera.width(), 0.5 * camera.height())),
      anchor_(position_of(light)) {
    LIGHTWELL_CHECK(handle != Handle::none);
    if (handle == Handle::aim) anchor_ = aim_of(camera, std::get<SpotLight>(light));
    if (handle == Handle::centre || handle == Handle::aim)
        grip_ = in_plane(cursor).value_or(anchor_) - anchor_;
    else
        axis_grip_ = along_axis(cursor).value_or(0);
}

const Light& HandleDrag::moved_to(const Vec2& cursor) {
    if (handle_ == Handle::centre || handle_ == Handle::aim) {
        const std::optional<Vec3> place = in_plane(cursor);
        if (!place) return light_;
        const Vec3 to = *place - grip_;
        if (handle_ == Handle::centre) {
            set_position(light_, to);
            return light_;
        }
        auto& spot = std::get<SpotLight>(light_);
        const Vec3 direction = to - spot.position;
        if (direction.norm() > 1e-3 * (anchor_ - spot.position).norm())
            spot.direction = direction.normalized();
        return light_;
    }
    if (const std::optional<double> along = along_axis(cursor))
        set_position(light_, position_of(start_) + (*along - axis_grip_) * axis());
    return light_;
}

Vec3 HandleDrag::axis() const {
    return Vec3::Unit(handle_ == Handle::x ? 0 : handle_ == Handle::y ? 1 : 2);
}

std::optional<double> HandleDrag::along_axis(const Vec2& cursor) const {
    // Where the axis comes nearest to the ray of the cursor.
    const Vec3 ray = camera_.direction(cursor[0], cursor[1]);
    const Vec3 to_light = position_of(start_) - camera_.position();
    const double cosine = ray.dot(axis());
    const double squared_sine = 1 - cosine * cosine;
    constexpr double least = 1e-4;
    if (squared_sine < least) return std::nullopt;
    const double along_ray = (ray.dot(to_light) - cosine * axis().dot(to_light)) / squared_sine;
    // Beyond the vanishing point of the axis the nearest place is behind the eye.
    if (!(along_ray > 0)) return std::nullopt;
    return (cosine * ray.dot(to_light) - axis().dot(to_light)) / squared_sine;
}

std::optional<Vec3> HandleDrag::in_plane(const Vec2& cursor) const {
    const Vec3 ray = camera_.direction(cursor[0], cursor[1]);
    const double depth = (anchor_ - camera_.position()).dot(facing_);
    const double cosine = ray.dot(facing_);
    if (!(depth > 0) || !(cosine > 0)) return std::nullopt;
    return camera_.position() + depth / cosine * ray;
}

}  // namespace lightwell
