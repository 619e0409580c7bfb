#pragma once

#include <array>
#include <vector>

#include "solver/reading/polygon_shape.h"

namespace lightwell {

/// Cuts a triangle into three quads: a corner, the middles of its two sides, and the centroid.
///
/// The cut is exact, and every quad is convex: two of its corners are midpoints, where the angle is
/// below 180 degrees because the line to the centroid leads inside; at the centroid the angles are
/// those between medians, below 180 degrees, too. All three have a third of the area. The obvious
/// alternative, a quad with two corners in one place, has a Jacobian that vanishes there: its cells
/// shrink to slivers around that corner, and points there have no parameters.
std::array<Quad, 3> cut_triangle(const Vec3& a, const Vec3& b, const Vec3& c);

/// A convex polygon as quads and at most one triangle, as indices of its corners.
struct ConvexCut {
    std::vector<std::array<int, 4>> quads;
    std::vector<std::array<int, 3>> triangles;  ///< none or one
};

/// Cuts a strictly convex polygon of n >= 4 corners into (n-2)/2 quads by parallel rungs, like a
/// ladder; an odd n leaves a triangle at the end of it. Of the n ladders, one for each starting
/// corner, it takes the one whose worst piece has the best corner (largest sine); the first of
/// equals. A ladder, not a fan: a fan gathers all its sharp angles at one corner.
ConvexCut cut_convex(const std::vector<Vec2>& outline);

/// Cuts a polygon of any shape into n-2 triangles by clipping ears, the roundest ear (by its
/// smallest sine) first. The corners are indices into the outline, counter-clockwise. The polygon
/// may touch itself; nothing comes back if it overlaps itself so that it cannot be cut.
///
/// The result is right by construction: the ears' indicator functions, counted with the sign of
/// their orientation, always sum to the outline's winding number; when none is negative, they tile
/// the polygon.
std::vector<std::array<int, 3>> clip_ears(const std::vector<Vec2>& outline);

}  // namespace lightwell
