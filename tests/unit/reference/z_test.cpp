#include "tests/unit/reference/z_test.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "radiance4d/failure.h"

namespace lightwell {

ZTest z_test(const std::vector<LightEstimate>& estimates, const std::vector<Rgb>& exact,
             double allowed) {
    LIGHTWELL_CHECK_OP(estimates.size(), ==, exact.size());
    ZTest result;
    for (std::size_t k = 0; k < exact.size(); ++k)
        for (int channel = 0; channel < 3; ++channel) {
            const double truth = exact[k][channel];
            const double noise = estimates[k].standard_error[channel];
            const double off = std::abs(estimates[k].mean[channel] - truth);
            // Without noise only rounding may be between the two.
            const double distance = noise > 0 ? off / noise
                                    : off <= 1e-9 * std::abs(truth)
                                        ? 0
                                        : std::numeric_limits<double>::infinity();
            ++result.tested;
            if (!(distance <= allowed)) ++result.outside;
            result.worst = std::max(result.worst, distance);
            if (truth != 0) result.largest_noise = std::max(result.largest_noise, noise / truth);
        }
    return result;
}

}  // namespace lightwell
