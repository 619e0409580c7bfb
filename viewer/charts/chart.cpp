#include "viewer/charts/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "viewer/charts/chart_page.h"

namespace lightwell {

namespace {

constexpr double width = 800, height = 480;
constexpr double left = 90, right = 280, top = 50, bottom = 60;

/// Told apart without red against green (Okabe and Ito 2008).
constexpr std::array<const char*, 7> colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                "#e69f00", "#56b4e9", "#000000"};
/// And without colour.
constexpr std::array<const char*, 7> dashes = {"none", "8 3",  "2 3", "8 3 2 3",
                                               "4 2",  "12 4", "1 2"};

/// A logarithmic axis from a pixel to another.
class Axis {
  public:
    Axis(double lowest, double highest, double from, double to)
        : low_(std::log10(lowest)), high_(std::log10(highest)), from_(from), to_(to) {
        // Some room at both ends, and some length where all values are one.
        const double margin = std::max(0.04 * (high_ - low_), 0.02);
        low_ -= margin;
        high_ += margin;
    }
    double at(double value) const {
        return from_ + (std::log10(value) - low_) / (high_ - low_) * (to_ - from_);
    }
    /// The same, but on the axis.
    double clamped(double value) const {
        return at(std::clamp(value, std::pow(10, low_), std::pow(10, high_)));
    }
    /// Round values on the axis: 1, 2 and 5 times powers of ten, or only powers over long ranges.
    std::vector<double> ticks() const {
        std::vector<double> values;
        for (double decade = std::floor(low_); decade <= high_; ++decade)
            for (const double step : {1.0, 2.0, 5.0}) {
                if (step > 1 && high_ - low_ > 3) continue;
                const double value = step * std::pow(10, decade);
                if (std::log10(value) >= low_ && std::log10(value) <= high_)
                    values.push_back(value);
            }
        return values;
    }

  private:
    double low_, high_, from_, to_;
};

std::string text_at(double x, double y, const std::string& anchor, const std::string& text,
                    const std::string& more = "") {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                       anchor, more, escaped(text));
}

std::string line_between(double x0, double y0, double x1, double y1) {
    return fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#ddd\"/>\n", x0, y0,
        x1, y1);
}

std::string drawn(const Series& series, const Axis& x, const Axis& y, std::size_t number) {
    const std::string colour = colours[number % colours.size()];
    std::string path, dots;
    for (std::size_t k = 0; k < series.points.size(); ++k) {
        const auto& [across, up] = series.points[k];
        path += fmt::format("{:.1f},{:.1f} ", x.at(across), y.at(up));
        if (series.is_limit) continue;
        if (k < series.spans.size())
            dots += fmt::format(
                "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" stroke=\"{3}\" stroke-opacity=\"0.5\"/>\n",
                x.at(across), y.clamped(series.spans[k].first), y.clamped(series.spans[k].second),
                colour);
        dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n",
                            x.at(across), y.at(up), colour);
    }
    return fmt::format(
               "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
               "stroke-dasharray=\"{}\"/>\n",
               path, colour, series.is_limit ? "1.2" : "2", dashes[number % dashes.size()]) +
           dots;
}

std::string legend_entry(const std::string& name, std::size_t number) {
    const double y = top + 20 * static_cast<double>(number + 1);
    const std::string colour = colours[number % colours.size()];
    return fmt::format(
               "<path d=\"M{:.1f} {:.1f}h26\" stroke=\"{}\" stroke-width=\"2\" "
               "stroke-dasharray=\"{}\"/>\n",
               width - right + 12, y - 4, colour, dashes[number % dashes.size()]) +
           text_at(width - right + 44, y, "start", name, " fill=\"" + colour + "\"");
}

std::string ring_at(double x, double y) {
    return fmt::format(
        "<ellipse cx=\"{:.1f}\" cy=\"{:.1f}\" rx=\"8\" ry=\"8\" fill=\"none\" "
        "stroke=\"black\" stroke-width=\"1.5\"/>\n",
        x, y);
}

}  // namespace

std::string svg_of(const Chart& chart) {
    double x_low = std::numeric_limits<double>::infinity(), x_high = 0, y_low = x_low, y_high = 0;
    for (const Series& series : chart.series)
        for (const auto& [across, up] : series.points) {
            x_low = std::min(x_low, across);
            x_high = std::max(x_high, across);
            y_low = std::min(y_low, up);
            y_high = std::max(y_high, up);
        }
    const Axis x(x_low, x_high, left, width - right);
    const Axis y(y_low, y_high, height - bottom, top);

    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
        "viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\" font-size=\"13\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        width, height);
    svg += text_at(left, 28, "start", chart.title, " font-size=\"16\"");
    for (const double value : x.ticks()) {
        svg += line_between(x.at(value), top, x.at(value), height - bottom);
        svg += text_at(x.at(value), height - bottom + 18, "middle", fmt::format("{:g}", value));
    }
    for (const double value : y.ticks()) {
        svg += line_between(left, y.at(value), width - right, y.at(value));
        svg += text_at(left - 8, y.at(value) + 4, "end", fmt::format("{:g}", value));
    }
    svg += text_at(0.5 * (left + width - right), height - 14, "middle", chart.x_label);
    const double middle = 0.5 * (top + height - bottom);
    svg += text_at(20, middle, "middle", chart.y_label,
                   fmt::format(" transform=\"rotate(-90 20 {:.1f})\"", middle));
    for (std::size_t k = 0; k < chart.series.size(); ++k) {
        svg += drawn(chart.series[k], x, y, k);
        svg += legend_entry(chart.series[k].name, k);
    }
    for (const auto& [across, up] : chart.ringed)
        svg += ring_at(x.at(across), y.at(up));
    if (!chart.ringed.empty()) {
        const double below = top + 20 * static_cast<double>(chart.series.size() + 1);
        svg += ring_at(width - right + 25, below - 4);
        svg += text_at(width - right + 44, below, "start", chart.ring_meaning);
    }
    return svg + "</svg>\n";
}

std::string csv_of(const Chart& chart) {
    std::string csv = fmt::format("series,{},{}\n", chart.x_label, chart.y_label);
    for (const Series& series : chart.series)
        for (const auto& [across, up] : series.points)
            csv += fmt::format("{},{},{}\n", series.name, across, up);
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
