#include "solver/reference/radiance_tracer.h"

#include <cstddef>
#include <cstdint>

namespace lightwell {

LightOfPath RadianceTracer::radiance(const std::vector<RadianceProbe>& probes, LightAsked asked,
                                     const PathTracing& how) const {
    return [this, &probes, asked, roulette_after = how.roulette_after](
               std::size_t k, PathChoices& choices, std::int64_t& rays) {
        return walk_.radiance(probes[k], asked, roulette_after, choices, rays);
    };
}

LightOfPath RadianceTracer::irradiance(const std::vector<SurfacePoint>& points,
                                       const PathTracing& how) const {
    return [this, &points, roulette_after = how.roulette_after](std::size_t k, PathChoices& choices,
                                                                std::int64_t& rays) {
        return walk_.irradiance(points[k], LightAsked::indirect, roulette_after, choices, rays);
    };
}

LightSurvey RadianceTracer::total(const std::vector<RadianceProbe>& probes,
                                  const PathTracing& how) const {
    return survey_by_paths(probes.size(), how, radiance(probes, LightAsked::without_lamps, how));
}

LightSurvey RadianceTracer::indirect(const std::vector<RadianceProbe>& probes,
                                     const PathTracing& how) const {
    return survey_by_paths(probes.size(), how, radiance(probes, LightAsked::indirect, how));
}

LightSurvey RadianceTracer::indirect_irradiance(const std::vector<SurfacePoint>& points,
                                                const PathTracing& how) const {
    return survey_by_paths(points.size(), how, irradiance(points, how));
}

LightSurvey RadianceTracer::indirect_irradiance_to(const NoiseTarget& target,
                                                   const std::vector<SurfacePoint>& points,
                                                   const PathTracing& how) const {
    return survey_to_noise(target, points.size(), how, irradiance(points, how));
}

}  // namespace lightwell
