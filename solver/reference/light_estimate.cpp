#include "solver/reference/light_estimate.h"

namespace lightwell {

LightEstimate estimate_from_batches(const std::vector<Rgb>& batch_means) {
    const auto count = static_cast<double>(batch_means.size());
    LightEstimate result;
    for (const Rgb& one : batch_means)
        result.mean += one / count;
    Rgb squares = Rgb::Zero();
    for (const Rgb& one : batch_means)
        squares += (one - result.mean).square();
    result.standard_error = (squares / (count * (count - 1))).sqrt();
    return result;
}

}  // namespace lightwell
