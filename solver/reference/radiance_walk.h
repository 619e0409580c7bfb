#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiance4d/scene/scene.h"
#include "radiance4d/scene/visibility.h"
#include "solver/reference/light_sources.h"
#include "solver/reference/light_walk.h"
#include "solver/reference/surface_points.h"

namespace lightwell {

/// Where radiance is asked for: the light that arrives at `position` against `direction`.
struct RadianceProbe {
    Vec3 position = Vec3::Zero();    ///< [m]
    Vec3 direction = Vec3::UnitX();  ///< unit, the way one looks
};

/// What emitting surfaces send out.
enum class EmissionLaw {
    as_stated,  ///< Material::emission, alike in all directions
    /// Material::emission times 1 - a(w): where all surfaces have the same emission, radiance is
    /// that everywhere, whatever they reflect (the furnace of Szirmay-Kalos et al. 2001).
    furnace,
};

/// One path after the other through a scene of any materials; each gives an unbiased estimate of
/// the light at its start. Directions at glossy surfaces are drawn from the lobe or from the
/// cosine, as often as the material reflects by either, and weighed by the mixture's density. Light
/// is found in two ways each, as LightWalk does.
class RadianceWalk {
  public:
    /// Keeps references to scene and visibility.
    RadianceWalk(const Scene& scene, const Visibility& visibility, const std::vector<Light>& lights,
                 EmissionLaw law);

    /// Irradiance along one path [lx].
    Rgb irradiance(const SurfacePoint& from, LightAsked asked, int roulette_after,
                   PathChoices& choices, std::int64_t& rays) const;
    /// Radiance along one path [cd/m2]. With LightAsked::indirect, what the surface that is seen
    /// makes of light that was reflected before it came there; else all, lamps included.
    Rgb radiance(const RadianceProbe& probe, LightAsked asked, int roulette_after,
                 PathChoices& choices, std::int64_t& rays) const;

  private:
    /// Where a path turns: a surface, or, without material, the sensor that it starts from.
    struct Vertex {
        SurfacePoint point;
        Eigen::Matrix3d frame;  ///< columns: two tangents, the normal
        const Material* material = nullptr;
        Vec3 back = Vec3::UnitZ();  ///< towards the start of the path, in the frame
        bool reflecting = true;
        Rgb emitted = Rgb::Zero();  ///< towards the start
    };

    Vertex sensor(const SurfacePoint& at) const;
    Vertex vertex(const Vec3& origin, const Vec3& direction, const Hit& hit) const;
    Rgb emitted(int quad, bool front, double cosine) const;

    Rgb walk(Vertex at, LightAsked asked, int roulette_after, PathChoices& choices,
             std::int64_t& rays) const;
    Rgb by_picked_emitter(const Vertex& at, PathChoices& choices, int step,
                          std::int64_t& rays) const;
    Rgb by_lamp_ray(const Vertex& at, PathChoices& choices, int step, std::int64_t& rays) const;
    Rgb from_lamps(const Vertex& at, double path_density, std::int64_t& rays) const;

    // The local rules of a vertex; directions are in its frame.
    /// Light that goes back along the path per radiance from a direction: f cos, or cos at the
    /// sensor.
    static Rgb response(const Vertex& at, const Vec3& direction);
    /// How often drawn_direction takes the lobe.
    static double lobe_share(const Vertex& at);
    static Vec3 drawn_direction(const Vertex& at, Vec2 square);
    static double density(const Vertex& at, const Vec3& direction);

    const Scene& scene_;
    const Visibility& visibility_;
    std::vector<Vec3> normals_;  ///< of the fronts, per quad
    LampSet lamps_;
    EmitterSet emitters_;
    EmissionLaw law_;
    /// a at cosines k/cells, per material; only for the furnace.
    std::vector<std::vector<Rgb>> albedo_;
};

}  // namespace lightwell
