#include "runtime/propagation/paced_budget.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

std::uint32_t PacedBudget::budget(double seconds) const {
    constexpr double most = 1e9;
    return static_cast<std::uint32_t>(std::clamp(seconds / seconds_each_, 1.0, most));
}

void PacedBudget::took(std::uint32_t coefficients, double seconds) {
    constexpr std::uint32_t fewest = 16;
    // The geometric mean, so that one frame in which others used the machine counts for little.
    constexpr double weight = 0.2;
    if (coefficients < fewest || !(seconds > 0)) return;
    seconds_each_ = std::pow(seconds_each_, 1 - weight) * std::pow(seconds / coefficients, weight);
}

}  // namespace lightwell
