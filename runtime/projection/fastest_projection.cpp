#include "runtime/projection/fastest_projection.h"

#include <chrono>

#include "radiance4d/failure.h"

namespace lightwell {

double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

std::unique_ptr<LightProjection> fastest_projection(
    std::vector<std::unique_ptr<LightProjection>> ways, const std::vector<Light>& lights,
    std::uint32_t functions, const SecondsClock& clock) {
    LIGHTWELL_CHECK(!ways.empty());
    PackedField direct = PackedField::Zero(4, functions);
    std::size_t fastest = 0;
    double least = 0;
    for (std::size_t k = 0; k < ways.size(); ++k) {
        ways[k]->project(lights, direct);
        const double begin = clock();
        ways[k]->project(lights, direct);
        const double seconds = clock() - begin;
        if (k > 0 && seconds >= least) continue;
        fastest = k;
        least = seconds;
    }
    return std::move(ways[fastest]);
}

}  // namespace lightwell
