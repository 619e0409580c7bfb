#pragma once

#include <vector>

#include "radiance4d/scene/convex_polygon.h"

namespace lightwell {

/// What a quad hides from a point x: every y whose segment from x meets the quad before it gets to
/// y. That is the cone from x through the quad, cut by the quad's own plane: five planes, exact.
///
/// A quad whose plane holds x (up to the rounding of the coordinates) hides nothing.
class Shadow {
  public:
    Shadow(const Vec3& x, const Quad& occluder);

    bool empty() const { return edge_count_ == 0; }
    const Vec3& apex() const { return apex_; }
    /// The planes relative to the apex, which is their origin: `edges` through the apex and an edge
    /// of the quad, and one through the quad. What is inside of all of them is in shadow.
    int edges() const { return edge_count_; }
    const Plane& edge(int k) const { return edges_[static_cast<std::size_t>(k)]; }
    const Plane& behind() const { return behind_; }
    /// About the solid angle of the quad seen from x [sr]; may exceed 4 pi when x is near. For
    /// sorting only.
    double breadth() const { return breadth_; }

    /// Takes the shadow away from convex coplanar pieces, given relative to x (x is their origin).
    /// `sliver` is the width [m] below which a piece vanishes; pieces that lie nowhere farther than
    /// `contact` [m] behind the quad's plane count as lying in it, and keep their light.
    void subtract_from(std::vector<ConvexPolygon>& pieces, double sliver, double contact) const;

    /// Whether all of a convex piece, given relative to x, lies in the shadow and farther than
    /// `contact` [m] behind the quad's plane: then subtract_from would leave nothing of it.
    bool covers(const ConvexPolygon& piece, double contact) const;

  private:
    bool misses(const ConvexPolygon& piece, double sliver, double contact) const;

    Vec3 apex_;
    double breadth_ = 0;
    std::array<Plane, 4> edges_;  ///< through x and an edge of the quad; inside is in shadow
    int edge_count_ = 0;
    Plane behind_;  ///< the quad's plane; inside is behind it, seen from x
};

}  // namespace lightwell
