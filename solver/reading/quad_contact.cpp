#include "solver/reading/quad_contact.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "radiance4d/scene/convex_polygon.h"

namespace lightwell {

namespace {

Plane plane_of(const Quad& quad) {
    const Vec3 normal = quad.normal();
    return {normal, normal.dot(quad.centre())};
}

/// The plane through side i of a quad, across the quad, that points inside.
Plane side_plane(const Quad& quad, const Vec3& normal, std::size_t i) {
    const Vec3& from = quad.vertex[i];
    const Vec3 inward = normal.cross(quad.vertex[(i + 1) % 4] - from).normalized();
    return {inward, inward.dot(from)};
}

double longest_diagonal(const Quad& quad) {
    return std::max((quad.vertex[2] - quad.vertex[0]).norm(),
                    (quad.vertex[3] - quad.vertex[1]).norm());
}

bool overlap(const Quad& a, const Quad& b, double tolerance) {
    ConvexPolygon common(b);
    const Vec3 normal = a.normal();
    for (std::size_t i = 0; i < 4; ++i)
        common = clipped(common, side_plane(a, normal, i), tolerance);
    const double width = 4 * tolerance;
    return common.area() > width * std::min(longest_diagonal(a), longest_diagonal(b));
}

/// Whether the segment in which b meets the plane of a goes through the inside of a.
bool goes_through(const Quad& a, const Plane& plane, const Quad& b, double tolerance) {
    std::vector<Vec3> ends;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 &p = b.vertex[i], &q = b.vertex[(i + 1) % 4];
        const double hp = plane.height(p), hq = plane.height(q);
        if ((hp >= 0) != (hq >= 0)) ends.push_back(p + hp / (hp - hq) * (q - p));
    }
    if (ends.size() != 2) return false;
    // The parameters of the segment that lie inside a by more than the tolerance.
    double from = 0, to = 1;
    for (std::size_t i = 0; i < 4; ++i) {
        const Plane side = side_plane(a, plane.normal, i);
        const double h0 = side.height(ends[0]) - tolerance, h1 = side.height(ends[1]) - tolerance;
        if (h0 < 0 && h1 < 0) return false;
        if (h0 < 0) from = std::max(from, h0 / (h0 - h1));
        if (h1 < 0) to = std::min(to, h0 / (h0 - h1));
    }
    return (to - from) * (ends[1] - ends[0]).norm() > tolerance;
}

}  // namespace

Contact contact_of(const Quad& a, const Quad& b, double tolerance) {
    const Plane plane = plane_of(a);
    double lowest = 0, highest = 0;
    for (const Vec3& corner : b.vertex) {
        lowest = std::min(lowest, plane.height(corner));
        highest = std::max(highest, plane.height(corner));
    }
    if (lowest >= -tolerance && highest <= tolerance)
        return overlap(a, b, tolerance) ? Contact::overlapping : Contact::none;
    if (lowest >= -tolerance || highest <= tolerance) return Contact::none;
    return goes_through(a, plane, b, tolerance) ? Contact::crossing : Contact::none;
}

bool lies_on(const Vec3& point, const Quad& quad, double tolerance) {
    const Plane plane = plane_of(quad);
    if (std::abs(plane.height(point)) > tolerance) return false;
    for (std::size_t i = 0; i < 4; ++i)
        if (side_plane(quad, plane.normal, i).height(point) < -tolerance) return false;
    return true;
}

}  // namespace lightwell
