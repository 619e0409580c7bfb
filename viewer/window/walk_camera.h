#pragma once

#include "radiance4d/scene/scene.h"
#include "viewer/window/walls.h"

namespace lightwell {

/// Where a walker wants to go, each in [-1,1].
struct WalkDirection {
    double forward = 0;  ///< along the view
    double right = 0;
    double up = 0;  ///< along the scene's up, wherever the view points
};

/// An eye that walks and looks around, always upright.
class WalkCamera {
  public:
    /// Stands and looks as the camera does; its roll is not kept.
    /// @param up  the scene's up, unit length
    WalkCamera(const Camera& camera, const Vec3& up);

    /// The camera as it stands now, its target at unit distance.
    Camera camera() const;
    const Vec3& position() const { return position_; }
    Vec3 forward() const;
    Vec3 right() const;
    double vertical_angle() const { return vertical_angle_; }  ///< [degrees]
    void set_vertical_angle(double degrees);                   ///< kept in [5, 120]

    /// Turns by so many degrees to the right and upwards; up and down end just before the zenith.
    void look(double right, double up);
    /// Walks for some seconds. @param walls what stops it, null: nothing
    void walk(const WalkDirection& direction, double seconds, const Walls* walls);

    double speed() const { return speed_; }  ///< [m/s]
    void set_speed(double speed);            ///< kept in [0.01, 1000]

  private:
    Vec3 up_, east_, north_;  ///< right-handed: east x north = up
    Vec3 position_;
    double yaw_ = 0;    ///< from north towards east [degrees]
    double pitch_ = 0;  ///< above the horizon [degrees]
    double vertical_angle_;
    double speed_ = 2;
};

}  // namespace lightwell
