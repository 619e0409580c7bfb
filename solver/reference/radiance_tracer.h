#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "solver/reference/light_estimate.h"
#include "solver/reference/path_tracer.h"
#include "solver/reference/radiance_walk.h"

namespace lightwell {

/// Estimates, one per probe or point, in the order asked.
struct LightSurvey {
    std::vector<LightEstimate> at;
    std::int64_t rays = 0;   ///< traced, of all kinds
    std::int64_t paths = 0;  ///< traced
};

/// Radiance and irradiance in scenes of any materials by path tracing: slow, plain, without bias,
/// and independent of every finite-element part of this program, so that it can judge them.
/// PathTracer does the same for the irradiance of diffuse scenes, with less noise.
///
/// Every random number depends on the seed and the place in the list only, so results do not depend
/// on the number of threads.
class RadianceTracer {
  public:
    /// Keeps references to scene and visibility; `visibility` is over the scene's quads in their
    /// order.
    RadianceTracer(const Scene& scene, const Visibility& visibility,
                   const std::vector<Light>& lights, EmissionLaw law = EmissionLaw::as_stated)
        : walk_(scene, visibility, lights, law) {}

    /// Radiance at the probes [cd/m2]: emitted, and reflected from whatever source.
    LightSurvey total(const std::vector<RadianceProbe>& probes, const PathTracing& how = {}) const;
    /// The part of it that was reflected before it reached the surface that is seen [cd/m2].
    LightSurvey indirect(const std::vector<RadianceProbe>& probes,
                         const PathTracing& how = {}) const;
    /// Irradiance by light that was reflected at least once [lx].
    LightSurvey indirect_irradiance(const std::vector<SurfacePoint>& points,
                                    const PathTracing& how = {}) const;
    /// The same to a given noise, as PathTracer::indirect_to.
    LightSurvey indirect_irradiance_to(const NoiseTarget& target,
                                       const std::vector<SurfacePoint>& points,
                                       const PathTracing& how = {}) const;

  private:
    /// One path's worth of light at place k.
    using Estimate = std::function<Rgb(std::size_t k, PathChoices& choices, std::int64_t& rays)>;
    /// @param samples  by place
    static LightSurvey survey(const std::vector<int>& samples, const PathTracing& how,
                              const Estimate& estimate);
    LightSurvey survey_irradiance(const std::vector<SurfacePoint>& points,
                                  const std::vector<int>& samples, const PathTracing& how) const;

    RadianceWalk walk_;
};

}  // namespace lightwell
