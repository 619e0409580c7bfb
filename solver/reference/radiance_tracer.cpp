#include "solver/reference/radiance_tracer.h"

#include <algorithm>
#include <cstddef>

#include <tbb/parallel_for.h>

#include "radiance4d/failure.h"
#include "solver/reference/random_stream.h"

namespace lightwell {

LightSurvey RadianceTracer::survey(std::size_t places, const PathTracing& how,
                                   const Estimate& estimate) {
    LIGHTWELL_CHECK_OP(how.batches, >=, 2);
    LightSurvey result;
    result.at.resize(places);
    std::vector<std::int64_t> rays(places, 0);
    const int per_batch = std::max(1, (how.samples + how.batches - 1) / how.batches);
    tbb::parallel_for(std::size_t{0}, places, [&](std::size_t p) {
        std::vector<Rgb> batch_means;
        for (int batch = 0; batch < how.batches; ++batch) {
            RandomStream random(how.seed, p, static_cast<std::uint64_t>(batch));
            PathChoices choices(static_cast<std::size_t>(per_batch), random);
            Rgb sum = Rgb::Zero();
            for (int k = 0; k < per_batch; ++k) {
                choices.start(static_cast<std::size_t>(k));
                sum += estimate(p, choices, rays[p]);
            }
            batch_means.push_back(sum / per_batch);
        }
        result.at[p] = estimate_from_batches(batch_means);
    });
    for (const std::int64_t count : rays)
        result.rays += count;
    return result;
}

LightSurvey RadianceTracer::total(const std::vector<RadianceProbe>& probes,
                                  const PathTracing& how) const {
    return survey(probes.size(), how, [&](std::size_t k, PathChoices& choices, std::int64_t& rays) {
        return walk_.radiance(probes[k], LightAsked::without_lamps, how.roulette_after, choices,
                              rays);
    });
}

LightSurvey RadianceTracer::indirect(const std::vector<RadianceProbe>& probes,
                                     const PathTracing& how) const {
    return survey(probes.size(), how, [&](std::size_t k, PathChoices& choices, std::int64_t& rays) {
        return walk_.radiance(probes[k], LightAsked::indirect, how.roulette_after, choices, rays);
    });
}

LightSurvey RadianceTracer::indirect_irradiance(const std::vector<SurfacePoint>& points,
                                                const PathTracing& how) const {
    return survey(points.size(), how, [&](std::size_t k, PathChoices& choices, std::int64_t& rays) {
        return walk_.irradiance(points[k], LightAsked::indirect, how.roulette_after, choices, rays);
    });
}

}  // namespace lightwell
