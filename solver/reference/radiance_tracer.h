#pragma once

#include <vector>

#include "solver/reference/noise_target.h"
#include "solver/reference/path_survey.h"
#include "solver/reference/radiance_walk.h"

namespace lightwell {

/// Radiance and irradiance in scenes of any materials by path tracing: slow, plain, without bias,
/// and independent of every finite-element part of this program, so that it can judge them.
/// PathTracer does the same for the irradiance of diffuse scenes, with less noise.
/// All surveys are by probe or point, and the same for any number of threads (see survey_by_paths).
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
    /// The same to a given noise (see survey_to_noise).
    LightSurvey indirect_irradiance_to(const NoiseTarget& target,
                                       const std::vector<SurfacePoint>& points,
                                       const PathTracing& how = {}) const;

  private:
    LightOfPath radiance(const std::vector<RadianceProbe>& probes, LightAsked asked,
                         const PathTracing& how) const;
    LightOfPath irradiance(const std::vector<SurfacePoint>& points, const PathTracing& how) const;

    RadianceWalk walk_;
};

}  // namespace lightwell
