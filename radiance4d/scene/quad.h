#pragma once

#include <array>

#include <Eigen/Core>

namespace lightwell {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
/// Linear Rec. 709 red, green, blue.
using Rgb = Eigen::Array3d;

/// Luminance of a linear Rec. 709 colour, in the colour's own unit (cd/m2, lx, ...).
inline double luminance(const Rgb& colour) {
    return 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2];
}

/// A convex planar quadrilateral [m]. Vertices run counter-clockwise seen from the front.
///
/// The parameters (u,v) in [0,1]^2 map bilinearly: (0,0), (1,0), (1,1), (0,1) are vertex 0, 1,
/// 2, 3. The normal is x_u cross x_v and points to the front. Lines of constant u or v are
/// straight, so every rectangle of parameters is a convex planar quad again.
struct Quad {
    std::array<Vec3, 4> vertex;

    /// x(u,v) [m].
    Vec3 point(double u, double v) const;
    /// Unit normal of the front.
    Vec3 normal() const;
    /// Area [m2].
    double area() const;
    /// dA/(du dv) at (u,v) [m2].
    double jacobian(double u, double v) const;
    /// (u,v) of a point in the quad's plane; points outside give parameters outside [0,1].
    Vec2 parameters(const Vec3& point) const;
    /// Mean of the vertices.
    Vec3 centre() const;
    /// The same quad seen from behind: u and v change places, so the normal turns round.
    Quad reversed() const;
    /// The part with parameters in [u0,u1] x [v0,v1].
    Quad part(double u0, double u1, double v0, double v1) const;
    /// Largest distance of a vertex from the plane through the centre with the mean normal [m].
    double out_of_plane() const;
};

}  // namespace lightwell
