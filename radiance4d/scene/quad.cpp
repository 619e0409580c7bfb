#include "radiance4d/scene/quad.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace lightwell {

namespace {

/// Twice the vector area of the quad: the cross product of its diagonals.
Vec3 doubled_vector_area(const Quad& quad) {
    return (quad.vertex[2] - quad.vertex[0]).cross(quad.vertex[3] - quad.vertex[1]);
}

}  // namespace

Vec3 Quad::point(double u, double v) const {
    return (1 - v) * ((1 - u) * vertex[0] + u * vertex[1]) +
           v * ((1 - u) * vertex[3] + u * vertex[2]);
}

Vec3 Quad::normal() const {
    return doubled_vector_area(*this).normalized();
}

double Quad::area() const {
    return 0.5 * doubled_vector_area(*this).norm();
}

double Quad::jacobian(double u, double v) const {
    const Vec3 along_u = (1 - v) * (vertex[1] - vertex[0]) + v * (vertex[2] - vertex[3]);
    const Vec3 along_v = (1 - u) * (vertex[3] - vertex[0]) + u * (vertex[2] - vertex[1]);
    return along_u.cross(along_v).norm();
}

Vec2 Quad::parameters(const Vec3& target) const {
    // Newton's method on the bilinear map, exact after one step for a parallelogram. The start, the
    // centre, lies in the convex quad, where the Jacobian is positive; for targets inside the quad
    // it converges quadratically.
    Vec2 uv(0.5, 0.5);
    for (int step = 0; step < 20; ++step) {
        const Vec3 rest = target - point(uv[0], uv[1]);
        const Vec3 a = (1 - uv[1]) * (vertex[1] - vertex[0]) + uv[1] * (vertex[2] - vertex[3]);
        const Vec3 b = (1 - uv[0]) * (vertex[3] - vertex[0]) + uv[0] * (vertex[2] - vertex[1]);
        const double aa = a.dot(a), ab = a.dot(b), bb = b.dot(b);
        const double determinant = aa * bb - ab * ab;
        if (!(determinant > 0)) break;
        const double ra = a.dot(rest), rb = b.dot(rest);
        const Vec2 change((bb * ra - ab * rb) / determinant, (aa * rb - ab * ra) / determinant);
        uv += change;
        if (change.squaredNorm() < 1e-28) break;
    }
    return uv;
}

Vec3 Quad::centre() const {
    return 0.25 * (vertex[0] + vertex[1] + vertex[2] + vertex[3]);
}

Quad Quad::reversed() const {
    return {{vertex[0], vertex[3], vertex[2], vertex[1]}};
}

Quad Quad::part(double u0, double u1, double v0, double v1) const {
    return {{point(u0, v0), point(u1, v0), point(u1, v1), point(u0, v1)}};
}

double Quad::out_of_plane() const {
    const Vec3 middle = centre();
    const Vec3 n = normal();
    double farthest = 0;
    for (const Vec3& corner : vertex)
        farthest = std::max(farthest, std::abs(n.dot(corner - middle)));
    return farthest;
}

}  // namespace lightwell
