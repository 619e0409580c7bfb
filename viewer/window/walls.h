#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// The point of a convex planar quad that is nearest to `point`.
Vec3 nearest_on(const Quad& quad, const Vec3& point);

/// What stops a person who walks: a sphere around the eye does not pass through quads, and slides
/// along them.
class Walls {
  public:
    /// @param quads  planar and convex
    /// @param radius of the sphere [m], > 0
    Walls(const std::vector<Quad>& quads, double radius);

    double radius() const { return radius_; }

    /// Where a step from `from` to `to` [m] ends. Whoever already stands closer to a quad than the
    /// radius is pushed away from it; where there is no room to be pushed to, the step is not made.
    Vec3 walk(const Vec3& from, const Vec3& to) const;

  private:
    struct Wall {
        Quad quad;
        Eigen::AlignedBox3d reach;  ///< where a centre touches it at most
    };

    bool push_out(Vec3& centre) const;

    std::vector<Wall> walls_;
    double radius_;
};

/// A radius for a scene's walker [m]: 0.2, or a fiftieth of the scene's diagonal if that is less.
double walker_radius(const std::vector<Quad>& quads);

}  // namespace lightwell
