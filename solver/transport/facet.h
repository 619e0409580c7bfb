#pragma once

#include <array>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// A cell of a quad as the kernel sees it: a planar convex polygon of three to eight vertices, or
/// nothing.
struct Facet {
    std::array<Vec3, 8> vertex;
    int count = 0;
    Vec3 normal = Vec3::Zero();  ///< unit, to the front

    /// The whole of a quad.
    static Facet of(const Quad& quad, const Vec3& normal);
    /// The part on or in front of the plane n.x = d, all of it moved by nothing: vertices within
    /// `tolerance` of the plane count as on it. Empty when no area remains.
    Facet in_front_of(const Vec3& n, double d, double tolerance) const;

    bool empty() const { return count == 0; }
    double area() const;   ///< [m2]
    Vec3 centre() const;   ///< mean of the vertices
    double reach() const;  ///< largest distance of a vertex from the centre [m]
};

}  // namespace lightwell
