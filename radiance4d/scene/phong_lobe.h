#pragma once

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// The normalised modified Phong lobe of reflectance 1 (see PhongLobe). Directions are unit vectors
/// in a frame whose z axis is the normal and point away from the surface, z >= 0.
class UnitPhong {
  public:
    /// @param exponent  n >= 0
    explicit UnitPhong(double exponent) : n_(exponent) {}

    /// The BRDF [1/sr], symmetric in its arguments.
    double value(const Vec3& in, const Vec3& out) const;
    /// Albedo a(theta): the share of the light from a direction of this cosine that is reflected,
    /// to 1e-12. It falls from 1 at normal incidence.
    double albedo(double cosine) const;
    /// Int f^2 cos dw over the other direction [1/sr]: how much the lobe concentrates light.
    double square(double cosine) const;
    /// A direction of density (n+1)/(2 pi) cos(alpha)^n per solid angle about the mirror direction
    /// of `given`; below the surface where the lobe is cut off.
    Vec3 sampled(const Vec3& given, const Vec2& square) const;
    /// That density [1/sr].
    double density(const Vec3& given, const Vec3& sampled) const;

  private:
    double n_;
};

}  // namespace lightwell
