#include "solver/reference/error_size.h"

#include <algorithm>
#include <cmath>

#include "solver/reference/deviation.h"

namespace lightwell {

namespace {

/// Means of what is shown.
LightMeasure mean_of(const ShownPoints& shown) {
    const std::vector<LightEstimate> darkness(shown.value.size());
    const Deviation deviation = deviation_from(darkness, shown.value, shown.weight);
    return {deviation.square, deviation.mean};
}

}  // namespace

LightMeasure measure_of(const std::vector<LightEstimate>& judged, const ShownPoints& few,
                        const ShownPoints& many) {
    const Deviation truth = deviation_from(judged, few.value, few.weight);
    // By the weights' expectation, not their sum: a ratio of two sums would be biased.
    double weights = 0;
    for (const double weight : few.weight)
        weights += weight / static_cast<double>(few.weight.size());
    LightMeasure here = mean_of(few);
    here.square *= weights;
    here.mean *= weights;
    const LightMeasure everywhere = mean_of(many);
    LightMeasure measure;
    if (here.square > 0) measure.square = truth.reference_square * everywhere.square / here.square;
    if (here.mean > 0) measure.mean = truth.reference_mean * everywhere.mean / here.mean;
    return measure;
}

void NoisySizes::add(double error, double noise, double weight) {
    seen_.push_back({std::abs(error), weight});
    square_ += weight * (error * error - noise * noise);
    seen_square_ += weight * error * error;
}

double NoisySizes::quantile(double share) const {
    const double scale = seen_square_ > 0 ? std::max(0.0, square_ / seen_square_) : 0;
    return std::sqrt(scale) * quantile_of(seen_, share);
}

void ErrorCollection::add(const std::vector<LightEstimate>& judged, const ShownPoints& shown,
                          const LightMeasure& measure, double lamp_weight) {
    const Deviation deviation = deviation_from(judged, shown.value, shown.weight);
    squares_.push_back({deviation.square / measure.square, lamp_weight});
    biases_.push_back({deviation.mean / measure.mean, lamp_weight});
    const double darkest = 0.01 * std::sqrt(measure.square / 3);
    for (std::size_t k = 0; k < judged.size(); ++k) {
        const double error = luminance(Rgb(shown.value[k] - judged[k].mean));
        const double noise = luminance(judged[k].standard_error);
        const double bright = std::max(darkest, luminance(judged[k].mean));
        const double weight = lamp_weight * shown.weight[k];
        lux_.add(lux_of_unit_lamp * error, lux_of_unit_lamp * noise, weight);
        relative_.add(error / bright, noise / bright, weight);
    }
}

ErrorSize ErrorCollection::size() const {
    ErrorSize size;
    size.relative_l2 = rms_interval(squares_);
    size.bias = mean_interval(biases_);
    for (std::size_t k = 0; k < error_percentiles.size(); ++k) {
        size.relative[k] = relative_.quantile(error_percentiles[k] / 100);
        size.lux[k] = lux_.quantile(error_percentiles[k] / 100);
    }
    return size;
}

}  // namespace lightwell
