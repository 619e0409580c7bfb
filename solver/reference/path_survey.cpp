#include "solver/reference/path_survey.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "radiance4d/failure.h"
#include "solver/reference/random_stream.h"

namespace lightwell {

namespace {

/// @param samples  by place
LightSurvey survey(const std::vector<int>& samples, const PathTracing& how,
                   const LightOfPath& light) {
    LIGHTWELL_CHECK_OP(how.batches, >=, 2);
    const std::size_t places = samples.size();
    LightSurvey result;
    result.at.resize(places);
    std::vector<std::int64_t> rays(places, 0);
    std::vector<std::int64_t> paths(places, 0);
    tbb::parallel_for(std::size_t{0}, places, [&](std::size_t p) {
        const int per_batch = std::max(1, (samples[p] + how.batches - 1) / how.batches);
        std::vector<Rgb> batch_means;
        for (int batch = 0; batch < how.batches; ++batch) {
            RandomStream random(how.seed, p, static_cast<std::uint64_t>(batch));
            PathChoices choices(static_cast<std::size_t>(per_batch), random);
            Rgb sum = Rgb::Zero();
            for (int k = 0; k < per_batch; ++k) {
                choices.start(static_cast<std::size_t>(k));
                sum += light(p, choices, rays[p]);
            }
            batch_means.push_back(sum / per_batch);
        }
        result.at[p] = estimate_from_batches(batch_means);
        paths[p] = std::int64_t{per_batch} * how.batches;
    });
    for (std::size_t p = 0; p < places; ++p) {
        result.rays += rays[p];
        result.paths += paths[p];
    }
    return result;
}

}  // namespace

LightSurvey survey_by_paths(std::size_t places, const PathTracing& how, const LightOfPath& light) {
    return survey(std::vector<int>(places, how.samples), how, light);
}

LightSurvey survey_to_noise(const NoiseTarget& target, std::size_t places, const PathTracing& how,
                            const LightOfPath& light) {
    PathTracing trial_how = how;
    trial_how.seed = RandomStream(how.seed).bits();
    const LightSurvey trial = survey_by_paths(places, trial_how, light);
    LightSurvey result =
        survey(samples_for(target, trial.at, how.samples, how.batches), how, light);
    result.rays += trial.rays;
    result.paths += trial.paths;
    return result;
}

}  // namespace lightwell
