#include "runtime/projection/fastest_projection.h"

#include <chrono>

#include "radiance4d/failure.h"

namespace lightwell {

double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

std::unique_ptr<LightProjection> fastest_projection(
    std::vector<std::unique_ptr<LightProjection>> ways, const std::vector<Light>& few,
    const std::vector<Light>& lights, std::uint32_t functions, const SecondsClock& clock) {
    LIGHTWELL_CHECK(!ways.empty());
    PackedField direct = PackedField::Zero(4, functions);
    constexpr double hopeless = 0.1, times_slower = 5;  // [s]; by lights that reach less
    const auto seconds_of_second = [&](LightProjection& way, const std::vector<Light>& of) {
        way.project(of, direct);
        const double begin = clock();
        way.project(of, direct);
        return clock() - begin;
    };
    std::size_t fastest = 0;
    double least = 0;
    for (std::size_t k = 0; k < ways.size(); ++k) {
        if (k > 0) {
            const double glimpse = seconds_of_second(*ways[k], few);
            if (glimpse > hopeless && glimpse > times_slower * least) continue;
        }
        const double seconds = seconds_of_second(*ways[k], lights);
        if (k > 0 && seconds >= least) continue;
        fastest = k;
        least = seconds;
    }
    return std::move(ways[fastest]);
}

}  // namespace lightwell
