#include "solver/reference/deviation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "radiance4d/failure.h"

namespace lightwell {

Deviation deviation_from(const std::vector<LightEstimate>& reference,
                         const std::vector<Rgb>& values, const std::vector<double>& weight) {
    LIGHTWELL_CHECK_OP(reference.size(), ==, values.size());
    if (!weight.empty()) LIGHTWELL_CHECK_OP(weight.size(), ==, values.size());
    double squares = 0, noise = 0, size = 0, difference = 0, sum = 0, weights = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double w = weight.empty() ? 1 : weight[k];
        const double variance = reference[k].standard_error.square().sum();
        const Rgb error = values[k] - reference[k].mean;
        squares += w * (error.square().sum() - variance);
        size += w * (reference[k].mean.square().sum() - variance);
        noise += w * variance;
        difference += w * error.sum();
        sum += w * reference[k].mean.sum();
        weights += w;
    }
    Deviation result;
    if (weights > 0) {
        result.square = squares / weights;
        result.mean = difference / weights;
        result.reference_square = size / weights;
        result.reference_mean = sum / weights;
    }
    if (!(size > 0)) return result;
    result.relative_rms = std::sqrt(std::max(0.0, squares) / size);
    result.noise = std::sqrt(noise / size);
    if (sum > 0) result.bias = difference / sum;
    result.reference_rms = std::sqrt(size / (3 * weights));
    return result;
}

}  // namespace lightwell
