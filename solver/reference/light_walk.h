#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "radiance4d/scene/scene.h"
#include "radiance4d/scene/visibility.h"
#include "solver/reference/light_sources.h"
#include "solver/reference/random_stream.h"
#include "solver/reference/surface_points.h"

namespace lightwell {

/// Which light counts at the first point of a path.
enum class LightAsked {
    indirect,       ///< reflected at least once
    without_lamps,  ///< all but what comes straight from lamps
};

/// The random choices of a batch of paths: those of the first vertices stratified over the batch,
/// the others plain.
class PathChoices {
  public:
    PathChoices(std::size_t paths, RandomStream& random);
    void start(std::size_t path) { path_ = path; }
    Vec2 direction(int vertex) { return choice(vertex, 0); }
    Vec2 lamp_ray(int vertex) { return choice(vertex, 1); }
    Vec2 emitter_point(int vertex) { return choice(vertex, 2); }
    double plain() { return random_.uniform(); }

  private:
    static constexpr int stratified_vertices = 2;
    static constexpr int kinds = 3;
    Vec2 choice(int vertex, int kind);

    RandomStream& random_;
    std::size_t path_ = 0;
    std::array<std::vector<Vec2>, std::size_t{stratified_vertices} * kinds> tables_;
};

/// One path after the other through a scene with lamps and emitting quads; each gives an unbiased
/// estimate of the irradiance at its first point.
class LightWalk {
  public:
    /// Keeps references to scene and visibility.
    LightWalk(const Scene& scene, const Visibility& visibility, const std::vector<Light>& lights);

    /// Irradiance along one path from `from` [lx]. Adds the rays traced to `rays`.
    Rgb estimate(const SurfacePoint& from, LightAsked asked, int roulette_after,
                 PathChoices& choices, std::int64_t& rays) const;

    /// Irradiance straight from the lamps [lx]: exact, one ray per lamp.
    Rgb straight_from_lamps(const SurfacePoint& at, std::int64_t& rays) const;

  private:
    /// A surface point with what the surface does to light there.
    struct Vertex {
        SurfacePoint point;
        Rgb albedo = Rgb::Zero();
        Rgb emitted = Rgb::Zero();
    };
    Vertex vertex(const Vec3& origin, const Vec3& direction, const Hit& hit) const;
    Rgb by_picked_emitter(const SurfacePoint& at, PathChoices& choices, int step,
                          std::int64_t& rays) const;
    Rgb by_lamp_ray(const SurfacePoint& at, PathChoices& choices, int step,
                    std::int64_t& rays) const;
    Rgb lamps_at_met(const SurfacePoint& met, double path_density, std::int64_t& rays) const;

    const Scene& scene_;
    const Visibility& visibility_;
    std::vector<Vec3> normals_;  ///< of the fronts, per quad
    LampSet lamps_;
    EmitterSet emitters_;
};

}  // namespace lightwell
