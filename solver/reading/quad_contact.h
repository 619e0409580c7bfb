#pragma once

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// How two planar convex quads lie to each other.
enum class Contact {
    none,         ///< apart, or they touch along sides or at corners
    overlapping,  ///< in one plane, with an area in common
    crossing      ///< each goes through the other's inside
};

/// Judges two quads; whatever is smaller than `tolerance` [m] is taken as nothing.
Contact contact_of(const Quad& a, const Quad& b, double tolerance);

/// Whether a point is on a quad, its sides included, to within `tolerance` [m].
bool lies_on(const Vec3& point, const Quad& quad, double tolerance);

}  // namespace lightwell
