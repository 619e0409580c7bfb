#include "viewer/stability/closed_forms.h"

#include <algorithm>
#include <cmath>

namespace lightwell::stability {

namespace {

/// Sum over the corners of a function that is the value of the rectangle from the origin.
template <typename FromOrigin>
double over_corners(const Rectangle& r, const FromOrigin& from_origin) {
    return from_origin(r.x1, r.y1) - from_origin(r.x0, r.y1) - from_origin(r.x1, r.y0) +
           from_origin(r.x0, r.y0);
}

}  // namespace

Rectangle common(const Rectangle& a, const Rectangle& b) {
    Rectangle both{std::max(a.x0, b.x0), std::min(a.x1, b.x1), std::max(a.y0, b.y0),
                   std::min(a.y1, b.y1)};
    if (both.x1 <= both.x0 || both.y1 <= both.y0) both = {0, 0, 0, 0};
    return both;
}

double flux_of_one_candela(double h, const Rectangle& rectangle) {
    return over_corners(rectangle, [h](double x, double y) {
        return std::atan(x * y / (h * std::sqrt(x * x + y * y + h * h)));
    });
}

double factor_to_parallel(double h, const Rectangle& rectangle) {
    return over_corners(rectangle, [h](double x, double y) {
        const double to_x = std::hypot(h, x), to_y = std::hypot(h, y);
        return (x / to_x * std::atan(y / to_x) + y / to_y * std::atan(x / to_y)) / (2 * M_PI);
    });
}

double factor_to_perpendicular(double d, const Rectangle& rectangle) {
    return over_corners(rectangle, [d](double x, double y) {
        const double slant = std::hypot(d, y);
        return (std::atan(x / d) - d / slant * std::atan(x / slant)) / (2 * M_PI);
    });
}

}  // namespace lightwell::stability
