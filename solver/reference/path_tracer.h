#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/scene/scene.h"
#include "radiance4d/scene/visibility.h"
#include "solver/reference/light_estimate.h"
#include "solver/reference/light_walk.h"
#include "solver/reference/noise_target.h"
#include "solver/reference/surface_points.h"

namespace lightwell {

/// How paths are traced.
struct PathTracing {
    int samples = 1024;      ///< paths per point; rounded up to a whole number per batch
    int batches = 32;        ///< independent groups, whose scatter gives the error; at least 2
    int roulette_after = 3;  ///< bounces that every path makes; then it goes on with chance albedo
    std::uint64_t seed = 1;
};

/// Irradiance with its noise [lx].
using IrradianceEstimate = LightEstimate;

struct IrradianceSurvey {
    std::vector<IrradianceEstimate> at;  ///< one per point, in the order asked
    std::int64_t rays = 0;               ///< rays traced, of all kinds
    std::int64_t paths = 0;              ///< paths traced
};

/// The irradiance of diffuse scenes by path tracing: slow, plain, without bias, and independent of
/// every finite-element part of this program, so that it can judge them.
///
/// From a point, cosine-distributed paths run through the scene. The light that a path picks up is
/// found in two ways each, combined by the balance heuristic (Veach 1997, section 9.2):
/// - from an emitting quad: the path runs into it, or a point on it is picked and tested with a
/// ray;
/// - from a lamp by way of one more surface point z: the path meets z and z is joined to the lamp,
///   or z is found by a ray from the lamp and joined to the path. The first has no bound where a
///   lamp hangs close to a surface, the second none where z is close to the path; the combination
///   is bounded by the smaller of the two, with nothing clamped.
/// The first two bounces are stratified within each batch. Every random number depends on the seed
/// and the point's place in the list only, so results do not depend on the number of threads.
class PathTracer {
  public:
    /// Keeps references to scene and visibility; `visibility` is over the scene's quads in their
    /// order.
    PathTracer(const Scene& scene, const Visibility& visibility, const std::vector<Light>& lights);

    /// Irradiance by light that was reflected at least once: all but what arrives straight from
    /// lamps and emitting quads.
    IrradianceSurvey indirect(const std::vector<SurfacePoint>& points,
                              const PathTracing& how = {}) const;
    /// All irradiance.
    IrradianceSurvey total(const std::vector<SurfacePoint>& points,
                           const PathTracing& how = {}) const;

    /// What arrives straight from lamps, exact.
    std::vector<Rgb> straight_from_lamps(const std::vector<SurfacePoint>& points,
                                         std::int64_t& rays) const;

    /// Indirect irradiance to a given noise. A trial run with how.samples paths tells how many each
    /// point needs; a fresh run, whose length its own outcome cannot influence, is the answer. rays
    /// and paths count both runs.
    IrradianceSurvey indirect_to(const NoiseTarget& target, const std::vector<SurfacePoint>& points,
                                 const PathTracing& how = {}) const;

  private:
    IrradianceSurvey survey(const std::vector<SurfacePoint>& points, LightAsked asked,
                            const std::vector<int>& samples, const PathTracing& how) const;

    LightWalk walk_;
};

}  // namespace lightwell
