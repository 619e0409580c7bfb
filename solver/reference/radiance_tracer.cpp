#include "solver/reference/radiance_tracer.h"

#include <algorithm>
#include <cstddef>

#include <tbb/parallel_for.h>

#include "radiance4d/failure.h"
#include "solver/reference/random_stream.h"

namespace lightwell {

namespace {

std::vector<int> alike(std::size_t places, const PathTracing& how) {
    return std::vector<int>(places, how.samples);
}

}  // namespace

LightSurvey RadianceTracer::survey(const std::vector<int>& samples, const PathTracing& how,
                                   const Estimate& estimate) {
    LIGHTWELL_CHECK_OP(how.batches, >=, 2);
    const std::size_t places = samples.size();
    const auto per_batch_at = [&](std::size_t p) {
        return std::max(1, (samples[p] + how.batches - 1) / how.batches);
    };
    LightSurvey result;
    result.at.resize(places);
    std::vector<std::int64_t> rays(places, 0);
    tbb::parallel_for(std::size_t{0}, places, [&](std::size_t p) {
        const int per_batch = per_batch_at(p);
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
    for (std::size_t p = 0; p < places; ++p) {
        result.rays += rays[p];
        result.paths += std::int64_t{per_batch_at(p)} * how.batches;
    }
    return result;
}

LightSurvey RadianceTracer::total(const std::vector<RadianceProbe>& probes,
                                  const PathTracing& how) const {
    const std::vector<int> samples = alike(probes.size(), how);
    return survey(samples, how, [&](std::size_t k, PathChoices& choices, std::int64_t& rays) {
        return walk_.radiance(probes[k], LightAsked::without_lamps, how.roulette_after, choices,
                              rays);
    });
}

LightSurvey RadianceTracer::indirect(const std::vector<RadianceProbe>& probes,
                                     const PathTracing& how) const {
    const std::vector<int> samples = alike(probes.size(), how);
    return survey(samples, how, [&](std::size_t k, PathChoices& choices, std::int64_t& rays) {
        return walk_.radiance(probes[k], LightAsked::indirect, how.roulette_after, choices, rays);
    });
}

LightSurvey RadianceTracer::survey_irradiance(const std::vector<SurfacePoint>& points,
                                              const std::vector<int>& samples,
                                              const PathTracing& how) const {
    return survey(samples, how, [&](std::size_t k, PathChoices& choices, std::int64_t& rays) {
        return walk_.irradiance(points[k], LightAsked::indirect, how.roulette_after, choices, rays);
    });
}

LightSurvey RadianceTracer::indirect_irradiance(const std::vector<SurfacePoint>& points,
                                                const PathTracing& how) const {
    return survey_irradiance(points, alike(points.size(), how), how);
}

LightSurvey RadianceTracer::indirect_irradiance_to(const NoiseTarget& target,
                                                   const std::vector<SurfacePoint>& points,
                                                   const PathTracing& how) const {
    PathTracing trial_how = how;
    trial_how.seed = RandomStream(how.seed).bits();
    const LightSurvey trial = indirect_irradiance(points, trial_how);
    LightSurvey result =
        survey_irradiance(points, samples_for(target, trial.at, how.samples, how.batches), how);
    result.rays += trial.rays;
    result.paths += trial.paths;
    return result;
}

}  // namespace lightwell
