#include "radiance4d/scene/form_factor.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace lightwell {

namespace {

/// The height of x over the polygon's plane has the least rounding error when taken from here.
const Vec3& nearest_vertex(const ConvexPolygon& polygon, const Vec3& x) {
    return *std::min_element(polygon.begin(), polygon.end(), [&](const Vec3& a, const Vec3& b) {
        return (a - x).squaredNorm() < (b - x).squaredNorm();
    });
}

/// The angle that the edge from a to b subtends, times the cosine between n and the normal of the
/// triangle (0, a, b) [rad].
double lambert_term(const Vec3& a, const Vec3& b, const Vec3& n) {
    // a x (b - a) equals a x b without its cancellation when the edge is short.
    const Vec3 product = a.cross(b - a);
    const double sine = product.norm(), cosine = a.dot(b);
    return sine > 0 ? n.dot(product) * (std::atan2(sine, cosine) / sine) : 0;
}

/// The point of the polygon nearest to the origin, which lies at `height` over its plane.
Vec3 nearest_to_origin(const ConvexPolygon& polygon, const Vec3& normal, double height) {
    const Vec3 foot = -height * normal;
    bool inside = true;
    Vec3 nearest = polygon[0];
    for (int i = 0; i < polygon.size(); ++i) {
        const Vec3& start = polygon[i];
        const Vec3 edge = polygon.after(i) - start;
        if (normal.dot(edge.cross(foot - start)) < 0) inside = false;
        const double squared = edge.squaredNorm();
        if (!(squared > 0)) continue;
        const Vec3 candidate = start + std::clamp(-start.dot(edge) / squared, 0.0, 1.0) * edge;
        if (candidate.squaredNorm() < nearest.squaredNorm()) nearest = candidate;
    }
    return inside ? foot : nearest;
}

/// Signed solid angle of the triangle (a, b, c) seen from the origin, which lies at `height` over
/// its plane, where a is the point nearest to the origin of a convex polygon that holds all three.
/// Then a.b and a.c are not negative, and no term below cancels another.
double triangle_solid_angle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal,
                            double height) {
    const double doubled_area = std::max(0.0, normal.dot((b - a).cross(c - a)));
    if (!(doubled_area > 0)) return 0;
    const double a_norm = a.norm(), b_norm = b.norm(), c_norm = c.norm();
    const double cosine = b.dot(c), both = b_norm * c_norm;
    // |b||c| + b.c, where the edge passes close to the origin by way of its conjugate.
    const double half_plane =
        cosine < 0 ? b.cross(c - b).squaredNorm() / (both - cosine) : both + cosine;
    return 2 * std::atan2(doubled_area * height,
                          a_norm * half_plane + a.dot(b) * c_norm + a.dot(c) * b_norm);
}

}  // namespace

double point_form_factor(const Vec3& x, const Vec3& n, const ConvexPolygon& polygon) {
    if (polygon.size() < 3) return 0;
    if (!(polygon.vector_area().dot(x - nearest_vertex(polygon, x)) > 0)) return 0;
    const ConvexPolygon above = clipped(polygon.moved(-x), Plane{n, 0}, 0);
    // Against the order of the vertices, so that the normals of the triangles point inwards.
    double sum = 0;
    for (int i = 0; i < above.size(); ++i)
        sum += lambert_term(above.after(i), above[i], n);
    return std::clamp(sum / (2 * M_PI), 0.0, 1.0);
}

double signed_solid_angle(const Vec3& x, const ConvexPolygon& polygon) {
    if (polygon.size() < 3) return 0;
    const Vec3 area = polygon.vector_area();
    const double length = area.norm();
    if (!(length > 0)) return 0;
    const Vec3 normal = area / length;
    const double height = normal.dot(x - nearest_vertex(polygon, x));
    if (height == 0) return 0;

    const ConvexPolygon seen = polygon.moved(-x);
    const Vec3 apex = nearest_to_origin(seen, normal, height);
    double sum = 0;
    for (int i = 0; i < seen.size(); ++i)
        sum += triangle_solid_angle(apex, seen[i], seen.after(i), normal, height);
    return sum;
}

double solid_angle(const Vec3& x, const ConvexPolygon& polygon) {
    return std::abs(signed_solid_angle(x, polygon));
}

}  // namespace lightwell
