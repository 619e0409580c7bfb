#pragma once

#include <array>
#include <optional>

#include "radiance4d/scene/light.h"
#include "runtime/drawing/camera_rays.h"

namespace lightwell {

/// What a light can be taken hold of by.
enum class Handle {
    none,
    centre,  ///< moves it in the plane that faces the eye
    x,       ///< moves it along an axis
    y,
    z,
    aim  ///< turns a spot
};

/// Where a light's handles appear in the picture [pixels from its upper left corner]; empty where
/// one is behind the eye. They keep their size in the picture, whatever the distance.
struct HandlePlaces {
    std::optional<Vec2> centre;
    std::array<std::optional<Vec2>, 3> axis;  ///< tips, along x, y and z
    std::optional<Vec2> aim;                  ///< of a spot
};
HandlePlaces handle_places(const CameraRays& camera, const Light& light);

/// The handle under the cursor: tips and aim before the shafts of axes, the centre before all.
Handle handle_at(const HandlePlaces& places, const Vec2& cursor);

/// A light that is being dragged by a handle. Follows the cursor in one plane or along one line
/// through where the light was, so that going back to where the drag began puts it back.
class HandleDrag {
  public:
    /// @param handle not Handle::none
    HandleDrag(const CameraRays& camera, const Light& light, Handle handle, const Vec2& cursor);

    Handle handle() const { return handle_; }
    /// The light with the cursor there. Where the cursor says nothing (the eye looks along the
    /// axis, or past the plane) it stays where it was last.
    const Light& moved_to(const Vec2& cursor);

  private:
    Vec3 axis() const;
    /// Along the axis from where the light was [m].
    std::optional<double> along_axis(const Vec2& cursor) const;
    /// In the plane through `anchor_` that faces the eye.
    std::optional<Vec3> in_plane(const Vec2& cursor) const;

    CameraRays camera_;
    Light start_, light_;
    Handle handle_;
    Vec3 facing_;  ///< normal of the plane
    Vec3 anchor_;  ///< what is dragged: the light itself, or the tip of the aim
    Vec3 grip_ = Vec3::Zero();
    double axis_grip_ = 0;
};

}  // namespace lightwell
