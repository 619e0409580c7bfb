#pragma once

#include <optional>
#include <vector>

#include "radiance4d/scene/convex_polygon.h"
#include "radiance4d/scene/quad.h"
#include "solver/reading/box_tree.h"

namespace lightwell {

/// A straight line from one point to another [m].
struct Segment {
    Vec3 from, to;
};

/// Where a quad stands on a plane with a side, or goes through it. There is nothing where it lies
/// in the plane, touches it with a corner or is off it; heights and lengths within `tolerance` [m]
/// are taken as nothing.
std::optional<Segment> contact_segment(const Quad& quad, const Plane& plane, double tolerance);

/// Finds where the quads of a scene stand on each other.
class WallContacts {
  public:
    /// @param quads      planar and convex; must outlive this
    /// @param tolerance  see contact_segment
    WallContacts(const std::vector<Quad>& quads, double tolerance);

    /// The contacts of other quads with the plane of a quad, as far as the boxes around both meet.
    /// They may reach beyond the quad.
    std::vector<Segment> on(int quad) const;

  private:
    const std::vector<Quad>& quads_;
    double tolerance_;
    BoxTree tree_;
};

}  // namespace lightwell
