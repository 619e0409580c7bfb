#pragma once

namespace lightwell::stability {

/// A rectangle of some plane's coordinates.
struct Rectangle {
    double x0, x1, y0, y1;
};

/// What two rectangles share, or one without area.
Rectangle common(const Rectangle& a, const Rectangle& b);

/// Flux [lm] that a point light of 1 cd at (0,0,h) sends through a rectangle of the plane z = 0.
double flux_of_one_candela(double h, const Rectangle& rectangle);

/// Form factor from a point to a rectangle of a parallel plane at distance h, with coordinates from
/// the foot of the perpendicular.
double factor_to_parallel(double h, const Rectangle& rectangle);

/// The same to a rectangle of a perpendicular plane at distance d: x along the line where the
/// planes meet, from the point's foot; y >= 0 above the point's plane.
double factor_to_perpendicular(double d, const Rectangle& rectangle);

}  // namespace lightwell::stability
