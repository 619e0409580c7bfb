#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/scene/scene.h"
#include "radiance4d/scene/visibility.h"
#include "solver/reference/light_walk.h"
#include "solver/reference/noise_target.h"
#include "solver/reference/path_survey.h"
#include "solver/reference/surface_points.h"

namespace lightwell {

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
/// The first two bounces are stratified within each batch. All surveys are by point [lx], and the
/// same for any number of threads (see survey_by_paths).
class PathTracer {
  public:
    /// Keeps references to scene and visibility; `visibility` is over the scene's quads in their
    /// order.
    PathTracer(const Scene& scene, const Visibility& visibility, const std::vector<Light>& lights);

    /// Irradiance by light that was reflected at least once: all but what arrives straight from
    /// lamps and emitting quads.
    LightSurvey indirect(const std::vector<SurfacePoint>& points,
                         const PathTracing& how = {}) const;
    /// All irradiance.
    LightSurvey total(const std::vector<SurfacePoint>& points, const PathTracing& how = {}) const;

    /// What arrives straight from lamps, exact.
    std::vector<Rgb> straight_from_lamps(const std::vector<SurfacePoint>& points,
                                         std::int64_t& rays) const;

    /// Indirect irradiance to a given noise (see survey_to_noise).
    LightSurvey indirect_to(const NoiseTarget& target, const std::vector<SurfacePoint>& points,
                            const PathTracing& how = {}) const;

  private:
    LightOfPath irradiance(const std::vector<SurfacePoint>& points, LightAsked asked,
                           const PathTracing& how) const;

    LightWalk walk_;
};

}  // namespace lightwell
