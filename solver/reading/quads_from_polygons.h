#pragma once

#include <vector>

#include "radiance4d/scene/scene.h"
#include "solver/reading/polygon_soup.h"
#include "solver/reading/triangle_pairing.h"

namespace lightwell {

/// How polygons become quads. Lengths are relative to the polygon's diameter.
struct PolygonRule {
    /// How far corners may lie from the mean plane. Within it, corners are moved onto the plane:
    /// transport takes quads as planar (one normal, a Jacobian without a twist), and a ray that
    /// meets the bilinear patch where the quad's two triangles are not would start inside a wall.
    /// Beyond it, the polygon is cut into triangles, which are planar as they are.
    double planarity = 1e-4;
    /// Least height of a corner over the line between its neighbours; flatter corners are left
    /// out. A polygon that is flat at all corners has no area.
    double flatness = 1e-6;
    PairingRule pairing;
};

/// Most corners a polygon may have; more is taken as damage.
constexpr int most_corners = 4096;

/// The elements of a scene, with materials as PolygonSoup numbers them (-1: none).
struct QuadsOfPolygons {
    std::vector<SceneQuad> quads;
    PolygonCounts counts;
    std::vector<Warning> warnings;
};

/// Makes planar, strictly convex quads of a soup's polygons [m]. Every point of a polygon's surface
/// is kept, to within the rule.
///
/// - A corner flatter than the rule is left out: it does not shape the polygon, and as a corner of
///   a quad its Jacobian would vanish. The T-vertex this may leave in a neighbour does no harm:
///   elements are not joined by their vertices.
/// - An outline that goes round several times is taken once.
/// - Convex planar quads are kept as they are, larger convex polygons are cut by a ladder of rungs
///   (see cut_convex), concave ones into triangles by clipping ears.
/// - A bent quad is cut along the diagonal that leaves the rounder triangles, a larger bent polygon
///   by clipping the ears of its outline seen along its mean normal, or, if the outline crosses
///   itself from there, as a fan from its first corner, as most programs do.
/// - Triangles, read or made, are paired where two make an exact convex quad (see pair_triangles),
///   and else cut into three quads (see cut_triangle).
/// - Polygons without area, and planar ones whose outline crosses itself, which bound no surface
///   one could name, are left out with a warning.
///
/// Quads come in the order of their polygons; a pair stands where its first polygon stands.
/// @param metres_per_unit length of the file's unit [m]
/// @throws InputError for a polygon of more than most_corners corners
QuadsOfPolygons quads_from_polygons(const PolygonSoup& soup, double metres_per_unit = 1,
                                    const PolygonRule& rule = {});

}  // namespace lightwell
