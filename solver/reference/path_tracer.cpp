#include "solver/reference/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <tbb/parallel_for.h>

#include "radiance4d/failure.h"
#include "solver/reference/random_stream.h"

namespace lightwell {

PathTracer::PathTracer(const Scene& scene, const Visibility& visibility,
                       const std::vector<Light>& lights)
    : walk_(scene, visibility, lights) {}

IrradianceSurvey PathTracer::survey(const std::vector<SurfacePoint>& points, LightAsked asked,
                                    const std::vector<int>& samples, const PathTracing& how) const {
    LIGHTWELL_CHECK_OP(how.batches, >=, 2);
    IrradianceSurvey result;
    result.at.resize(points.size());
    std::vector<std::int64_t> rays(points.size(), 0);
    std::vector<std::int64_t> paths(points.size(), 0);
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t p) {
        const int per_batch = std::max(1, (samples[p] + how.batches - 1) / how.batches);
        std::vector<Rgb> batch_means;
        for (int batch = 0; batch < how.batches; ++batch) {
            RandomStream random(how.seed, p, static_cast<std::uint64_t>(batch));
            PathChoices choices(static_cast<std::size_t>(per_batch), random);
            Rgb sum = Rgb::Zero();
            for (int k = 0; k < per_batch; ++k) {
                choices.start(static_cast<std::size_t>(k));
                sum += walk_.estimate(points[p], asked, how.roulette_after, choices, rays[p]);
            }
            batch_means.push_back(sum / per_batch);
        }
        result.at[p] = estimate_from_batches(batch_means);
        paths[p] = std::int64_t{per_batch} * how.batches;
    });
    for (std::size_t p = 0; p < points.size(); ++p) {
        result.rays += rays[p];
        result.paths += paths[p];
    }
    return result;
}

IrradianceSurvey PathTracer::indirect(const std::vector<SurfacePoint>& points,
                                      const PathTracing& how) const {
    return survey(points, LightAsked::indirect, std::vector<int>(points.size(), how.samples), how);
}

IrradianceSurvey PathTracer::total(const std::vector<SurfacePoint>& points,
                                   const PathTracing& how) const {
    IrradianceSurvey result = survey(points, LightAsked::without_lamps,
                                     std::vector<int>(points.size(), how.samples), how);
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

IrradianceSurvey PathTracer::indirect_to(const NoiseTarget& target,
                                         const std::vector<SurfacePoint>& points,
                                         const PathTracing& how) const {
    PathTracing trial_how = how;
    trial_how.seed = RandomStream(how.seed).bits();
    const IrradianceSurvey trial = indirect(points, trial_how);
    const std::vector<int> samples = samples_for(target, trial.at, how.samples, how.batches);
    IrradianceSurvey result = survey(points, LightAsked::indirect, samples, how);
    result.rays += trial.rays;
    result.paths += trial.paths;
    return result;
}

}  // namespace lightwell
