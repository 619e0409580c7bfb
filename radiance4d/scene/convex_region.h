#pragma once

#include <array>

#include <Eigen/Geometry>

#include "radiance4d/scene/convex_polygon.h"

namespace lightwell {

/// A convex part of space: an axis-aligned box, cut by planes whose inside is kept. It bounds what
/// can stand between two things; a quad that only touches it from outside stands in nobody's way.
class ConvexRegion {
  public:
    static constexpr int capacity = 24;

    explicit ConvexRegion(const Eigen::AlignedBox3d& box) : box_(box) {}

    /// Cuts the region; at most `capacity` times.
    void cut(const Plane& plane) {
        LIGHTWELL_CHECK_OP(count_, <, capacity);
        planes_[static_cast<std::size_t>(count_++)] = plane;
    }

    const Eigen::AlignedBox3d& box() const { return box_; }
    /// The planes that it was cut by.
    int planes() const { return count_; }
    const Plane& plane(int k) const { return planes_[static_cast<std::size_t>(k)]; }

    /// Whether the quad lies on or outside one side of the box or one plane. Conservative: false
    /// may be wrong, true is not.
    bool misses(const Quad& quad) const;
    /// Whether all of a box lies on or outside one side of the region's box or one plane.
    bool misses(const Eigen::AlignedBox3d& other) const;

  private:
    Eigen::AlignedBox3d box_;
    std::array<Plane, capacity> planes_;
    int count_ = 0;
};

/// The pyramid from x to a polygon: everything between a point and a polygon of up to 22 vertices.
ConvexRegion region_between(const Vec3& x, const ConvexPolygon& polygon);

}  // namespace lightwell
