#pragma once

#include "radiance4d/scene/convex_polygon.h"

namespace lightwell {

/// A cell of a quad as the kernel sees it: an outline, which may be empty, and the normal of its
/// element, which the outline of a sliver could not tell.
struct Facet : ConvexPolygon {
    Vec3 normal = Vec3::Zero();  ///< unit, to the front

    /// The whole of a quad.
    static Facet of(const Quad& quad, const Vec3& normal);
    /// The part in front of the plane n.x = d; see clipped() for what `tolerance` [m] does.
    Facet in_front_of(const Vec3& n, double d, double tolerance) const;
};

}  // namespace lightwell
