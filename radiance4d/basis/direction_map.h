#pragma once

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// The angular domain (s,t) in [0,1]^2 of the hemisphere around a normal: the concentric map of
/// Shirley and Chiu (1997) onto the unit disk, lifted to the hemisphere. It is area-preserving on
/// the disk, so ds dt = cos(theta) dw / pi: the cosine is integrated already (WRT section 4.1).
///
/// Directions are in the local frame of the quad: x along x_u, z along the normal.
Vec3 direction_from_square(const Vec2& st);

/// Inverse of direction_from_square for unit directions with z >= 0.
Vec2 square_from_direction(const Vec3& direction);

/// Direction k of n on the spherical Fibonacci spiral (Keinert et al. 2015): even over the sphere.
Vec3 spiral_direction(int k, int n);

/// The orthonormal frame of a quad: columns x (along x_u), y, z (the normal).
Eigen::Matrix3d local_frame(const Quad& quad);

}  // namespace lightwell
