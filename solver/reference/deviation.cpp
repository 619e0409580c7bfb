#include "solver/reference/deviation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "radiance4d/failure.h"

namespace lightwell {

Deviation deviation_from(const std::vector<IrradianceEstimate>& reference,
                         const std::vector<Rgb>& values) {
    LIGHTWELL_CHECK_OP(reference.size(), ==, values.size());
    double differences = 0, noise = 0, size = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        differences += (values[k] - reference[k].mean).square().sum();
        noise += reference[k].standard_error.square().sum();
        size += reference[k].mean.square().sum();
    }
    Deviation result;
    const double true_size = size - noise;
    if (!(true_size > 0)) return result;
    result.relative_rms = std::sqrt(std::max(0.0, differences - noise) / true_size);
    result.noise = std::sqrt(noise / true_size);
    return result;
}

}  // namespace lightwell
