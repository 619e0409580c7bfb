#include "solver/reference/noise_target.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lightwell {

namespace {

/// Standard error of luminance, taking the channels' errors as fully correlated (they share every
/// ray), which overstates it if anything.
double luminance_error(const LightEstimate& estimate) {
    return luminance(estimate.standard_error);
}

}  // namespace

std::vector<int> samples_for(const NoiseTarget& target, const std::vector<LightEstimate>& trial,
                             int samples, int batches) {
    double squares = 0;
    for (const LightEstimate& one : trial)
        squares += std::pow(luminance(one.mean), 2);
    const auto count = static_cast<double>(std::max<std::size_t>(1, trial.size()));
    const double least_measure = target.floor * std::sqrt(squares / count);

    // A trial's own error is uncertain by an eighth with 32 batches: ask for a third more.
    const double margin = 1.33;
    const double fewest = 4.0 * batches;
    const double most = std::max(fewest, static_cast<double>(target.most_samples));
    std::vector<int> needed;
    for (const LightEstimate& one : trial) {
        const double allowed = target.relative * std::max(luminance(one.mean), least_measure);
        const double excess = allowed > 0 ? luminance_error(one) / allowed : 0;
        needed.push_back(
            static_cast<int>(std::clamp(margin * samples * excess * excess, fewest, most)));
    }
    return needed;
}

}  // namespace lightwell
