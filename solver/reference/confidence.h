#pragma once

#include <vector>

namespace lightwell {

/// An estimate with the interval that contains what it estimates in 95 of 100 repetitions.
struct Interval {
    double value = 0;
    double low = 0;
    double high = 0;
};

/// A value with the weight with which it counts.
struct WeighedValue {
    double value = 0;
    double weight = 1;  ///< >= 0
};

/// The mean of a population from independent samples of it, by Student's t.
/// @param samples  at least two; weights are the inverse of the chance to be drawn, but for a
/// factor
Interval mean_interval(const std::vector<WeighedValue>& samples);

/// The root of the mean of a population that is nowhere negative, such as squared errors, from
/// independent samples of it; a sample may carry noise of its own and be negative.
///
/// Squared errors are skewed: most are small, a few are large. Student's t for the logarithm of
/// their mean (the delta method) covers both ends about evenly; where the mean is not known to half
/// of itself, the plain interval of the mean. The upper end is raised by twice what the samples'
/// skewness makes of Student's t (Johnson 1978): whoever has not drawn the rare large ones must
/// expect them.
/// @param squares  at least two, weighed as for mean_interval
Interval rms_interval(const std::vector<WeighedValue>& squares);

/// Student's quantile for a two-sided interval of 95 %, to within 1 % from three degrees of freedom
/// on (Abramowitz and Stegun, 26.7.5).
double student_quantile(int degrees_of_freedom);

/// The value that a share of the weight, in [0,1], does not exceed; 0 if there is no weight.
double quantile_of(std::vector<WeighedValue> values, double share);

}  // namespace lightwell
