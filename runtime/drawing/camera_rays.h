#pragma once

#include "radiance4d/scene/quad.h"
#include "radiance4d/scene/scene.h"

namespace lightwell {

/// A camera in front of a picture of width x height square pixels.
///
/// Points of the picture are (x,y) [pixels] from its upper left corner, x to the right and y down;
/// the centre of the pixel in column i and row j is (i + 1/2, j + 1/2). With
///     forward = (target - position) / |..|,  right = forward x up / |..|,  top = right x forward,
///     f = (height / 2) / tan(vertical_angle / 2)
/// the ray of (x,y) starts at the position and runs along
///     forward + (x - width / 2) / f * right - (y - height / 2) / f * top.
class CameraRays {
  public:
    /// @throws InputError if the camera's target is its position, its up runs along its axis, or
    /// its angle is not in (0,180) degrees.
    CameraRays(const Camera& camera, int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }
    const Vec3& position() const { return position_; }
    /// f above [pixels].
    double focal_length() const { return focal_length_; }

    /// The rows are the unit vectors right, top and forward.
    Eigen::Matrix3d frame() const;

    /// Unit direction of the ray through (x,y).
    Vec3 direction(double x, double y) const;
    /// A point's coordinates along right, top and forward, from the camera [m].
    Vec3 in_camera(const Vec3& point) const;
    /// The point of the picture where `point`, which is not behind the camera, is seen.
    Vec2 project(const Vec3& point) const;

  private:
    int width_, height_;
    double focal_length_;
    Vec3 position_, right_, top_, forward_;
};

}  // namespace lightwell
