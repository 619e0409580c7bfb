#pragma once

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// The GGX lobe of reflectance 1 (see GgxLobe). Directions are unit vectors in a frame whose z axis
/// is the normal and point away from the surface, z >= 0.
class UnitGgx {
  public:
    /// @param roughness  alpha in (0,1]
    explicit UnitGgx(double roughness) : alpha_(roughness) {}

    /// The BRDF D G2 / (4 cos_i cos_o) [1/sr], symmetric in its arguments; bounded at grazing
    /// angles.
    double value(const Vec3& in, const Vec3& out) const;
    /// Albedo a(theta): the share of the light from a direction of this cosine that is reflected
    /// once and leaves, in [0,1], to 3e-5.
    double albedo(double cosine) const;
    /// Int f^2 cos dw over the other direction [1/sr]: how much the lobe concentrates light.
    double square(double cosine) const;
    /// A direction from the facets that `given` sees, each as often as it is seen (Heitz 2018);
    /// below the surface where a facet mirrors it there.
    Vec3 sampled(const Vec3& given, const Vec2& square) const;
    /// Its density G1 D / (4 cos) [1/sr].
    double density(const Vec3& given, const Vec3& sampled) const;

  private:
    /// Smith's Lambda: hidden over visible area of facets, seen under this cosine, times the
    /// cosine: finite at grazing angles.
    double hidden(double cosine) const;
    double facets(const Vec3& half) const;
    /// The mean of G2/G1 times `weight(given, out)` over what `sampled` draws, none below the
    /// surface: Int f weight cos dw.
    template <typename Weight>
    double mean_reflected(double cosine, const Weight& weight) const;

    double alpha_;
};

}  // namespace lightwell
