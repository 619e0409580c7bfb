#pragma once

#include <vector>

#include "radiance4d/basis/smooth_surface.h"
#include "radiance4d/operator/global_transport.h"
#include "radiance4d/scene/visibility.h"

namespace lightwell {

/// Indirect irradiance at any point by one last gathering over the hemisphere: what surfaces around
/// reflect, read from a smooth reconstruction, where a ray says which surface. Not blocky, and the
/// error of the stored light is averaged over all that the point sees.
class FinalGather {
  public:
    /// The references must outlive the gather.
    /// @param incident  smooth total irradiance [lx] by element: direct and indirect
    /// @param strata    directions along either side of the cosine-weighted hemisphere; strata^2
    /// rays a point
    FinalGather(const GlobalTransport& transport, const Visibility& visibility,
                std::vector<SmoothSurface> incident, int strata);

    /// Indirect irradiance [lx] at a point with a unit normal, lying on a quad of the scene or on
    /// none (free_point).
    Rgb irradiance(const Vec3& point, const Vec3& normal, int on_quad) const;

  private:
    const GlobalTransport& transport_;
    const Visibility& visibility_;
    std::vector<SmoothSurface> incident_;
    std::vector<Rgb> albedo_;       ///< mean, by material
    std::vector<Vec3> directions_;  ///< cosine-distributed about z, one per stratum
};

}  // namespace lightwell
