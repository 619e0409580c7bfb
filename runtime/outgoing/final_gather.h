#pragma once

#include <vector>

#include "radiance4d/basis/smooth_surface.h"
#include "radiance4d/operator/global_transport.h"
#include "radiance4d/scene/direct_light.h"
#include "radiance4d/scene/light.h"
#include "radiance4d/scene/visibility.h"
#include "runtime/outgoing/glossy_light.h"
#include "runtime/outgoing/lamp_spots.h"
#include "runtime/outgoing/square_mean.h"

namespace lightwell {

/// Lamps whose light on elements near to them is computed where a ray meets these, instead of read.
struct ExactLamps {
    const DirectLight* direct = nullptr;
    std::vector<NearLamp> lamps;
};

/// Indirect light at any point by one last gathering over the hemisphere: what surfaces around
/// reflect, read from a smooth reconstruction, where a ray says which surface. Not blocky, and the
/// error of the stored light is averaged over all that the point sees. Half of the rays go where
/// the others found differences: to small bright places, far ones for example (see SquareMean).
/// Places that a lamp lights from near are too small for that: rays of the lamp look for the point
/// instead. Where both ways may meet, each counts by its share of the rays (Veach and Guibas 1995,
/// the balance heuristic).
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
    /// One of many that a point sends.
    struct Ray {
        const Vec3& point;
        int quad;  ///< on which the point lies, or free_point
        Vec3 direction;
        double per_sr;  ///< rays that are sent about this direction
    };
    /// Radiance that surfaces reflect against a ray; zero where it meets none. Of the light of near
    /// lamps only the share of such rays.
    GatheredRadiance against(const Ray& ray) const;
    /// Radiance that an element reflects there, without near lamps.
    Rgb reflected(std::size_t element, const Vec3& at, const Vec3& towards) const;
    /// Lamps near to the element: the share of rays that meet it at `per_area` [1/m2].
    Rgb by_near_lamps(std::size_t element, const Vec3& at, const Vec3& towards,
                      double per_area) const;
    /// Whether an element has directions.
    bool shines(std::size_t element) const {
        return glossy_ != nullptr && glossy_->is_glossy(element);
    }
    /// What a point of an element makes of light from one direction.
    Rgb brdf_of(std::size_t element, const Vec3& from, const Vec3& towards) const;
    /// The share of the spots of near lamps. `receives` says of a unit direction what the point
    /// makes of a radiance from there, and how many rays it sends about it [1/sr].
    template <typename Receives>
    Rgb from_spots(const Vec3& point, int on_quad, const Receives& receives) const;

    const GlobalTransport& transport_;
    const Visibility& visibility_;
    std::vector<SmoothSurface> incident_;
    const GlossyLight* glossy_;
    const DirectLight* direct_;
    std::vector<std::vector<Light>> near_;  ///< exact lamps by element; empty: none anywhere
    std::vector<LampSpot> spots_;           ///< that they light
    std::vector<Rgb> albedo_;               ///< mean, by material
    SquareMean mean_;                       ///< over cosine-distributed directions
    std::vector<Vec2> square_;  ///< a jittered point of each stratum of the unit square: the rays
};

}  // namespace lightwell
