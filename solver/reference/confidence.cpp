#include "solver/reference/confidence.h"

#include <algorithm>
#include <cmath>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

struct Mean {
    double value = 0;
    double half = 0;  ///< half the width of the interval
};

Mean mean_of(const std::vector<double>& samples) {
    LIGHTWELL_CHECK_OP(samples.size(), >=, std::size_t{2});
    const auto count = static_cast<double>(samples.size());
    Mean mean;
    for (const double sample : samples)
        mean.value += sample / count;
    double squares = 0;
    for (const double sample : samples)
        squares += (sample - mean.value) * (sample - mean.value);
    mean.half = student_quantile(static_cast<int>(samples.size()) - 1) *
                std::sqrt(squares / (count * (count - 1)));
    return mean;
}

double root(double square) {
    return std::sqrt(std::max(0.0, square));
}

}  // namespace

double student_quantile(int degrees_of_freedom) {
    constexpr double z = 1.959963984540054;
    const double n = degrees_of_freedom;
    const double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
    return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n) +
           (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * n * n * n);
}

Interval mean_interval(const std::vector<double>& samples) {
    const Mean mean = mean_of(samples);
    return {mean.value, mean.value - mean.half, mean.value + mean.half};
}

Interval rms_interval(const std::vector<double>& squares) {
    const Mean mean = mean_of(squares);
    if (mean.half > 0.5 * mean.value)
        return {root(mean.value), root(mean.value - mean.half), root(mean.value + mean.half)};
    const double spread = std::exp(0.5 * mean.half / mean.value);
    return {root(mean.value), root(mean.value) / spread, root(mean.value) * spread};
}

double quantile_of(std::vector<WeighedValue> values, double share) {
    std::sort(values.begin(), values.end(),
              [](const WeighedValue& a, const WeighedValue& b) { return a.value < b.value; });
    double all = 0;
    for (const WeighedValue& one : values)
        all += one.weight;
    double below = 0;
    for (const WeighedValue& one : values) {
        below += one.weight;
        if (one.weight > 0 && below >= share * all) return one.value;
    }
    return 0;
}

}  // namespace lightwell
