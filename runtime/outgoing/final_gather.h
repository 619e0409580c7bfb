#pragma once

#include <vector>

#include "radiance4d/basis/smooth_surface.h"
#include "radiance4d/operator/global_transport.h"
#include "radiance4d/scene/direct_light.h"
#include "radiance4d/scene/light.h"
#include "radiance4d/scene/visibility.h"
#include "runtime/outgoing/glossy_light.h"
#include "runtime/outgoing/square_mean.h"

namespace lightwell {

/// Lamps whose light on an element is computed where a ray meets it, instead of read: those that
/// hang so near that its cells cannot show what they light.
struct ExactLamps {
    const DirectLight* direct = nullptr;
    std::vector<std::vector<Light>> on;  ///< by element; empty: none anywhere
};

/// Indirect light at any point by one last gathering over the hemisphere: what surfaces around
/// reflect, read from a smooth reconstruction, where a ray says which surface. Not blocky, and the
/// error of the stored light is averaged over all that the point sees. Half of the rays go where
/// the others found differences: to small bright places, far ones for example (see SquareMean).
class FinalGather {
  public:
    /// The references must outlive the gather.
    /// @param incident  smooth total irradiance [lx] by element: direct and indirect, without what
    /// `exact` adds
    /// @param strata    directions along either side of the cosine-weighted hemisphere; strata^2
    /// rays a point, and as many for a lobe
    /// @param glossy    what leaves glossy surfaces; nullptr where there are none
    FinalGather(const GlobalTransport& transport, const Visibility& visibility,
                std::vector<SmoothSurface> incident, int strata,
                const GlossyLight* glossy = nullptr, ExactLamps exact = {});

    /// Indirect irradiance [lx] at a point with a unit normal, lying on a quad of the scene or on
    /// none (free_point).
    Rgb irradiance(const Vec3& point, const Vec3& normal, int on_quad) const;
    /// Radiance that the lobe of a glossy element alone sends from a point of it towards a unit
    /// direction: rays are drawn from the lobe, and so as fine as it is.
    GatheredRadiance from_lobe(std::size_t element, const Vec3& point, const Vec3& direction) const;

  private:
    /// Diffusely reflected radiosity at a point of an element [lx].
    Rgb reflected(std::size_t element, const Vec3& at) const;
    /// Radiance that surfaces reflect against a ray; zero where it meets none.
    GatheredRadiance against(const Vec3& point, int on_quad, const Vec3& direction) const;

    const GlobalTransport& transport_;
    const Visibility& visibility_;
    std::vector<SmoothSurface> incident_;
    const GlossyLight* glossy_;
    ExactLamps exact_;
    std::vector<Rgb> albedo_;   ///< mean, by material
    SquareMean mean_;           ///< over cosine-distributed directions
    std::vector<Vec2> square_;  ///< a jittered point of each stratum of the unit square
};

}  // namespace lightwell
