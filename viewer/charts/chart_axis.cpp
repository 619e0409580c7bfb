#include "viewer/charts/chart_axis.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace lightwell {

namespace {

/// Multiples of powers of ten between two values.
std::vector<double> multiples(const std::vector<double>& steps, double lowest, double highest) {
    std::vector<double> values;
    for (double decade = std::floor(std::log10(lowest)); decade <= std::log10(highest); ++decade)
        for (const double step : steps) {
            const double value = step * std::pow(10, decade);
            if (value >= lowest && value <= highest) values.push_back(value);
        }
    return values;
}

/// From 1 to below 10 in such steps.
std::vector<double> every(double step) {
    std::vector<double> values;
    for (int k = 0; 1 + k * step < 10 - step / 2; ++k)
        values.push_back(1 + k * step);
    return values;
}

}  // namespace

ChartAxis::ChartAxis(double lowest, double highest, double from, double to, Scale scale)
    : scale_(scale), low_(on_scale(lowest)), high_(on_scale(highest)), from_(from), to_(to) {
    // Some room at both ends, and some length where all values are one.
    const double margin = std::max(0.04 * (high_ - low_), 0.02);
    low_ -= margin;
    high_ += margin;
}

double ChartAxis::on_scale(double value) const {
    return scale_ == Scale::linear ? value : std::log10(value);
}

double ChartAxis::value_of(double on_scale) const {
    return scale_ == Scale::linear ? on_scale : std::pow(10, on_scale);
}

double ChartAxis::at(double value) const {
    return from_ + (on_scale(value) - low_) / (high_ - low_) * (to_ - from_);
}

std::vector<double> ChartAxis::ticks() const {
    std::vector<double> values;
    if (scale_ == Scale::linear) {
        const double step = std::max(1.0, std::ceil((high_ - low_) / 12));
        for (double value = std::ceil(low_); value <= high_; value += step)
            values.push_back(value);
        return values;
    }
    constexpr std::size_t enough = 4;
    for (const std::vector<double>& steps :
         {std::vector<double>{1}, std::vector<double>{1, 2, 5}, every(1), every(0.5), every(0.2)}) {
        values = multiples(steps, lowest(), highest());
        if (values.size() >= enough) break;
    }
    return values;
}

std::string tick_text(double value) {
    constexpr double thousand = 1e3, million = 1e6;
    if (value >= million) return fmt::format("{:g} M", value / million);
    if (value >= 10 * thousand) return fmt::format("{:g} k", value / thousand);
    return fmt::format("{:g}", value);
}

}  // namespace lightwell
