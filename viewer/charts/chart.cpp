#include "viewer/charts/chart.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace lightwell {

namespace {

/// The columns low, high, setting and ringed of a point.
std::string further_columns(const Chart& chart, const Series& series, std::size_t point) {
    std::string columns = ",,";
    if (point < series.spans.size())
        columns = fmt::format(",{},{}", series.spans[point].first, series.spans[point].second);
    columns += "," + (point < series.labels.size() ? csv_field(series.labels[point]) : "");
    const bool is_ringed =
        !series.is_limit && std::find(chart.ringed.begin(), chart.ringed.end(),
                                      series.points[point]) != chart.ringed.end();
    return columns + (is_ringed ? ",1" : ",0");
}

}  // namespace

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char one : text)
        quoted += one == '"' ? "\"\"" : std::string(1, one);
    return quoted + "\"";
}

std::string csv_of(const Chart& chart) {
    const bool has_more =
        !chart.ringed.empty() ||
        std::any_of(chart.series.begin(), chart.series.end(), [](const Series& series) {
            return !series.spans.empty() || !series.labels.empty();
        });
    std::string csv =
        fmt::format("series,{},{}{}\n", csv_field(chart.x_label), csv_field(chart.y_label),
                    has_more ? ",low,high,setting,ringed" : "");
    for (const Series& series : chart.series)
        for (std::size_t k = 0; k < series.points.size(); ++k)
            csv += fmt::format("{},{},{}{}\n", csv_field(series.name), series.points[k].first,
                               series.points[k].second,
                               has_more ? further_columns(chart, series, k) : "");
    return csv;
}

PowerLaw fitted_power(const std::vector<std::pair<double, double>>& points) {
    double x_sum = 0, y_sum = 0, squares = 0, products = 0;
    for (const auto& [across, up] : points) {
        x_sum += std::log(across);
        y_sum += std::log(up);
    }
    const auto n = static_cast<double>(points.size());
    for (const auto& [across, up] : points) {
        const double x = std::log(across) - x_sum / n;
        squares += x * x;
        products += x * (std::log(up) - y_sum / n);
    }
    PowerLaw law;
    law.exponent = products / squares;
    law.factor = std::exp((y_sum - law.exponent * x_sum) / n);
    return law;
}

}  // namespace lightwell
