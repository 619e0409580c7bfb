#include "viewer/commands/level_view.h"

#include <algorithm>
#include <cmath>

#include "viewer/images/false_colour.h"

namespace lightwell {

namespace {

constexpr double border_pixels = 0.7;  // half the width of a border

/// Distance from x in [0,n] to the nearest whole number.
double to_border(double x) {
    return std::abs(x - std::round(x));
}

/// Whether a point of the element is nearer than `reach` [m] to the border of a finest cell.
bool on_border(const Element& element, const Vec3& position, double reach) {
    const CellTree& tree = element.space.tree();
    const Vec2 uv = element.geometry.parameters(position);
    const auto& x = element.geometry.vertex;
    const Vec3 along_u = (1 - uv[1]) * (x[1] - x[0]) + uv[1] * (x[2] - x[3]);
    const Vec3 along_v = (1 - uv[0]) * (x[3] - x[0]) + uv[0] * (x[2] - x[1]);
    const double cell_u = along_u.norm() / tree.columns(), cell_v = along_v.norm() / tree.rows();
    return to_border(uv[0] * tree.columns()) * cell_u < reach ||
           to_border(uv[1] * tree.rows()) * cell_v < reach;
}

}  // namespace

Shade level_shade(const RadianceSpace& space, const CameraRays& camera) {
    int deepest = 1;
    for (const Element& element : space.elements())
        deepest = std::max(deepest, element.space.tree().levels());
    const Vec3 eye = camera.position();
    const double pixels_per_angle = camera.focal_length();
    return [&space, deepest, eye, pixels_per_angle](int quad, bool front, const Vec3& position,
                                                    const Vec3& to_eye) -> Rgb {
        const int e = space.element_on(quad, front);
        if (e < 0) return Rgb::Constant(0.02);
        const Element& element = space.element(static_cast<std::size_t>(e));
        const double pixel = (position - eye).norm() / pixels_per_angle;  // [m]
        const double share = static_cast<double>(element.space.tree().levels()) / deepest;
        const Rgb colour = ramp_colour(share).cast<double>() *
                           (0.4 + 0.6 * std::abs(element.geometry.normal().dot(to_eye)));
        return on_border(element, position, border_pixels * pixel) ? Rgb(0.15 * colour) : colour;
    };
}

}  // namespace lightwell
