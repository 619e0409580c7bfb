#pragma once

#include <vector>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// The corners of a polygon in order, counter-clockwise seen from its front.
using Outline = std::vector<Vec3>;

/// Largest distance between two corners.
double diameter(const Outline& outline);

/// Vector area (Newell): normal times area of a planar polygon, and the mean over all
/// triangulations of a bent one. Zero-length for polygons without area.
Vec3 vector_area(const Outline& outline);

/// Largest distance of a corner from the mean plane: through the mean of the corners, across the
/// vector area.
double out_of_plane(const Outline& outline);

/// The outline with every corner moved onto the mean plane.
Outline flattened(const Outline& outline);

/// Indices of the corners that shape the outline. Left out are repeated corners, corners on the
/// line between their neighbours, and whiskers that go out and come back, each judged by the height
/// of the triangle (before, corner, after) over its longest side, which must exceed `tolerance`
/// [m]. Fewer than three are left of a polygon without area.
std::vector<int> shaping_corners(const Outline& outline, double tolerance);

/// Corners in coordinates of the mean plane; counter-clockwise outlines stay so.
std::vector<Vec2> in_mean_plane(const Outline& outline);

/// Whether the outline turns left at every corner and goes round once.
bool is_convex(const std::vector<Vec2>& outline);

/// Whether two sides cross at inner points of both. Outlines that only touch themselves do not
/// cross: a hole is often joined to the outer rim by a bridge that is walked twice.
bool crosses_itself(const std::vector<Vec2>& outline);

/// z of the cross product: positive where the path a, b, c turns left.
inline double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

}  // namespace lightwell
