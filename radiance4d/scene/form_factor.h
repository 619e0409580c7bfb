#pragma once

#include "radiance4d/scene/convex_polygon.h"

namespace lightwell {

/// The form factor from the surface element at x with unit normal n to a polygon, nothing between:
/// the share in [0,1] of the cosine-weighted hemisphere over x that the polygon covers. The element
/// receives pi L times this from a polygon of luminance L.
///
/// Only the front of the polygon counts: 0 if x is behind it or in its plane (reverse the polygon
/// to ask for its back). The part below the horizon of x is clipped off.
///
/// Error: a few 1e-16, times the ratio of the coordinates to x's distance from the nearest edge
/// where the edge is not parallel to an axis.
/// Lambert, Photometria (1760); Baum, Rushmeier, Winget, SIGGRAPH 1989, equation 5.
double point_form_factor(const Vec3& x, const Vec3& n, const ConvexPolygon& polygon);

/// Solid angle of a polygon seen from x [sr], in (-2 pi, 2 pi): positive if x is in front,
/// negative behind, 0 in its plane. Relative error of a few roundings, for small angles too.
/// Van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30 (1983), equation 8, for the triangles
/// around the polygon's nearest point.
double signed_solid_angle(const Vec3& x, const ConvexPolygon& polygon);

/// The absolute value of the above: either side counts.
double solid_angle(const Vec3& x, const ConvexPolygon& polygon);

}  // namespace lightwell
