#include "solver/reference/path_tracer.h"

#include <cstddef>

namespace lightwell {

PathTracer::PathTracer(const Scene& scene, const Visibility& visibility,
                       const std::vector<Light>& lights)
    : walk_(scene, visibility, lights) {}

LightOfPath PathTracer::irradiance(const std::vector<SurfacePoint>& points, LightAsked asked,
                                   const PathTracing& how) const {
    return [this, &points, asked, roulette_after = how.roulette_after](
               std::size_t p, PathChoices& choices, std::int64_t& rays) {
        return walk_.estimate(points[p], asked, roulette_after, choices, rays);
    };
}

LightSurvey PathTracer::indirect(const std::vector<SurfacePoint>& points,
                                 const PathTracing& how) const {
    return survey_by_paths(points.size(), how, irradiance(points, LightAsked::indirect, how));
}

LightSurvey PathTracer::total(const std::vector<SurfacePoint>& points,
                              const PathTracing& how) const {
    LightSurvey result =
        survey_by_paths(points.size(), how, irradiance(points, LightAsked::without_lamps, how));
    const std::vector<Rgb> straight = straight_from_lamps(points, result.rays);
    for (std::size_t p = 0; p < points.size(); ++p)
        result.at[p].mean += straight[p];
    return result;
}

std::vector<Rgb> PathTracer::straight_from_lamps(const std::vector<SurfacePoint>& points,
                                                 std::int64_t& rays) const {
    std::vector<Rgb> straight;
    for (const SurfacePoint& point : points)
        straight.push_back(walk_.straight_from_lamps(point, rays));
    return straight;
}

LightSurvey PathTracer::indirect_to(const NoiseTarget& target,
                                    const std::vector<SurfacePoint>& points,
                                    const PathTracing& how) const {
    return survey_to_noise(target, points.size(), how,
                           irradiance(points, LightAsked::indirect, how));
}

}  // namespace lightwell
