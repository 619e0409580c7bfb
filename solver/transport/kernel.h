#pragma once

#include "solver/transport/facet.h"

namespace lightwell {

/// The diffuse kernel without visibility, F(x,y) = cos_x cos_y / (pi r^2) [1/m2], zero where either
/// looks away. It has no colour and is symmetric (WRT eq. 3 and 4 with a constant BRDF).
double kernel(const Vec3& x, const Vec3& normal_x, const Vec3& y, const Vec3& normal_y);

/// The exchange area Int Int F dA_x dA_y [m2] of two convex polygons, each wholly in front of the
/// other's plane and nothing between: A_x times the form factor from x to y, and the same from y to
/// x.
///
/// Near pairs by Stokes' theorem as a double contour integral of ln r (Sparrow 1963; Schroeder and
/// Hanrahan 1993), with closed forms along parallel edges, so that touching cells are exact where
/// sampling 1/r^2 has infinite variance. Far pairs, where the contour integral loses digits to
/// cancellation, by a product Gauss rule. Relative error about 1e-6 and below.
double exchange_area(const Facet& x, const Facet& y);

/// The contour integral alone, at any distance: exact geometry, rounding grows with
/// (distance/size)^4.
double exchange_area_by_contour(const Facet& x, const Facet& y);

/// The Gauss rule alone: relative error falls with (size/distance)^4.
double exchange_area_by_points(const Facet& x, const Facet& y);

}  // namespace lightwell
