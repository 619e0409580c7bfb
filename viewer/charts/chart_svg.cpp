#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "viewer/charts/chart.h"
#include "viewer/charts/chart_axis.h"
#include "viewer/charts/chart_page.h"

namespace lightwell {

namespace {

constexpr double width = 860, height = 500;
constexpr double left = 80, right = 300, top = 50, bottom = 60;
constexpr double letter = 7;  // width of one, about

/// Told apart without red against green (Okabe and Ito 2008).
constexpr std::array<const char*, 6> colours = {"#0072b2", "#d55e00", "#009e73",
                                                "#cc79a7", "#000000", "#b88600"};
/// And without colour: by dashes, and by what marks a point around the origin.
constexpr std::array<const char*, 4> dashes = {"none", "9 4", "2 3", "9 3 2 3"};
constexpr std::array<const char*, 4> markers = {"m-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0z",
                                                "m-4-4h8v8h-8z", "m0-5l5 9h-10z",
                                                "m0-5.5l5.5 5.5l-5.5 5.5l-5.5-5.5z"};
constexpr const char* limit_colour = "#777777";
constexpr const char* limit_dashes = "6 4";

/// Look as SVG wants it.
struct Pen {
    std::string colour, dashes, marker;
};

Pen pen_of(const Series& series, std::size_t number) {
    if (series.is_limit) return {limit_colour, limit_dashes, ""};
    const auto next = static_cast<int>(number);
    const SeriesLook look = series.look.value_or(SeriesLook{next, next});
    const auto colour = static_cast<std::size_t>(look.colour) % colours.size();
    const auto form = static_cast<std::size_t>(look.form) % dashes.size();
    return {colours[colour], series.is_joined ? dashes[form] : "", markers[form]};
}

/// Ends of what an axis shows.
struct Range {
    double low = std::numeric_limits<double>::infinity(), high = 0;

    void take(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

Range across_of(const Chart& chart) {
    Range range;
    for (const Series& series : chart.series)
        for (const auto& point : series.points)
            range.take(point.first);
    return range;
}

/// Points, and their intervals as far as these are at most twice or half of them.
Range up_of(const Chart& chart) {
    Range range;
    for (const Series& series : chart.series)
        for (std::size_t k = 0; k < series.points.size(); ++k) {
            const double up = series.points[k].second;
            range.take(up);
            if (k >= series.spans.size()) continue;
            range.take(std::max(series.spans[k].first, up / 2));
            range.take(std::min(series.spans[k].second, 2 * up));
        }
    return range;
}

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

std::string marker_at(double x, double y, const Pen& pen, const std::string& more = "") {
    return fmt::format("<path{} d=\"M{:.1f} {:.1f}{}\" fill=\"{}\"/>\n", more, x, y, pen.marker,
                       pen.colour);
}

/// An interval in y around a point; arrows where it leaves the axis.
std::string span_at(double x, const std::pair<double, double>& span, const ChartAxis& y,
                    const std::string& colour) {
    const double low = y.at(std::max(span.first, y.lowest())),
                 high = y.at(std::min(span.second, y.highest()));
    std::string path = fmt::format("M{:.1f} {:.1f}V{:.1f}", x, low, high);
    if (span.first < y.lowest()) path += fmt::format("M{:.1f} {:.1f}l4 -6m-4 6l-4 -6", x, low);
    if (span.second > y.highest()) path += fmt::format("M{:.1f} {:.1f}l4 6m-4 -6l-4 6", x, high);
    return fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-opacity=\"0.5\" fill=\"none\"/>\n",
                       path, colour);
}

std::string line_of(const std::string& path, const Pen& pen) {
    return fmt::format(
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
        "stroke-dasharray=\"{}\"/>\n",
        path, pen.colour, pen.marker.empty() ? "1.5" : "2", pen.dashes);
}

/// Places what points are called, so that no name stands on another as long as there is room.
class PointNames {
  public:
    /// Beside a point: up or down, to the right or to the left.
    void add(double x, double y, const std::string& name) {
        constexpr double size = 11, aside = 7, up = -5, down = 13;
        const double length = 0.9 * letter * static_cast<double>(name.size());
        const std::array<Box, 4> places{{{x + aside, y + up, length, size},
                                         {x + aside, y + down, length, size},
                                         {x - aside - length, y + up, length, size},
                                         {x - aside - length, y + down, length, size}}};
        const auto is_free = [this](const Box& place) {
            return std::none_of(taken_.begin(), taken_.end(),
                                [&](const Box& other) { return meet(place, other); });
        };
        const auto is_free_inside = [&](const Box& place) {
            return place.left > left && is_free(place);
        };
        const auto* found = std::find_if(places.begin(), places.end(), is_free_inside);
        if (found == places.end()) found = std::find_if(places.begin(), places.end(), is_free);
        const Box& place = found == places.end() ? places.front() : *found;
        taken_.push_back(place);
        drawn_ += text_at(place.left, place.bottom, "start", name,
                          fmt::format(" font-size=\"{}\" paint-order=\"stroke\" stroke=\"white\" "
                                      "stroke-width=\"3\"",
                                      size));
    }

    /// To be drawn over all else.
    const std::string& drawn() const { return drawn_; }

  private:
    struct Box {
        double left, bottom, width, height;
    };
    static bool meet(const Box& a, const Box& b) {
        return a.left < b.left + b.width && b.left < a.left + a.width &&
               a.bottom - a.height < b.bottom && b.bottom - b.height < a.bottom;
    }

    std::vector<Box> taken_;
    std::string drawn_;
};

std::string drawn(const Series& series, const ChartAxis& x, const ChartAxis& y, const Pen& pen,
                  PointNames& names) {
    std::string path, marks;
    for (std::size_t k = 0; k < series.points.size(); ++k) {
        const double across = x.at(series.points[k].first), up = y.at(series.points[k].second);
        path += fmt::format("{}{:.1f} {:.1f}", k == 0 ? "M" : "L", across, up);
        if (k < series.spans.size()) marks += span_at(across, series.spans[k], y, pen.colour);
        if (!pen.marker.empty()) marks += marker_at(across, up, pen, " class=\"point\"");
        if (series.shows_labels && k < series.labels.size())
            names.add(across, up, series.labels[k]);
    }
    return (pen.dashes.empty() ? "" : line_of(path, pen)) + marks;
}

double legend_line(std::size_t number) {
    return top + 20 * static_cast<double>(number + 1);
}

std::string legend_entry(const std::string& name, std::size_t number, const Pen& pen) {
    const double x = width - right + 12, y = legend_line(number);
    std::string key;
    if (!pen.dashes.empty()) key += line_of(fmt::format("M{:.1f} {:.1f}h34", x, y - 4), pen);
    if (!pen.marker.empty()) key += marker_at(x + 17, y - 4, pen);
    return key + text_at(x + 42, y, "start", name);
}

std::string ring_at(double x, double y) {
    return fmt::format(
        "<ellipse cx=\"{:.1f}\" cy=\"{:.1f}\" rx=\"8\" ry=\"8\" fill=\"none\" "
        "stroke=\"black\" stroke-width=\"1.2\"/>\n",
        x, y);
}

std::string grid_of(const ChartAxis& x, const ChartAxis& y) {
    std::string grid;
    double free_from = 0;
    for (const double value : x.ticks()) {
        const double at = x.at(value);
        grid += line_between(at, top, at, height - bottom);
        const std::string text = tick_text(value);
        const double half = 0.5 * letter * static_cast<double>(text.size()) + 4;
        if (at - half < free_from) continue;  // would run into the one before
        grid += text_at(at, height - bottom + 18, "middle", text);
        free_from = at + half;
    }
    for (const double value : y.ticks()) {
        grid += line_between(left, y.at(value), width - right, y.at(value));
        grid += text_at(left - 8, y.at(value) + 4, "end", tick_text(value));
    }
    return grid + fmt::format(
                      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" "
                      "stroke=\"#888\"/>\n",
                      left, top, width - right - left, height - bottom - top);
}

}  // namespace

std::string svg_of(const Chart& chart) {
    const Range across = across_of(chart), up = up_of(chart);
    const ChartAxis x(across.low, across.high, left, width - right,
                      chart.x_counts ? ChartAxis::Scale::linear : ChartAxis::Scale::logarithmic);
    const ChartAxis y(up.low, up.high, height - bottom, top);

    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
        "viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\" font-size=\"13\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        width, height);
    svg += text_at(left, 28, "start", chart.title, " font-size=\"16\"");
    svg += grid_of(x, y);
    svg += text_at(0.5 * (left + width - right), height - 14, "middle", chart.x_label);
    const double middle = 0.5 * (top + height - bottom);
    svg += text_at(20, middle, "middle", chart.y_label,
                   fmt::format(" transform=\"rotate(-90 20 {:.1f})\"", middle));
    PointNames names;
    for (std::size_t k = 0; k < chart.series.size(); ++k) {
        const Pen pen = pen_of(chart.series[k], k);
        svg += drawn(chart.series[k], x, y, pen, names);
        svg += legend_entry(chart.series[k].name, k, pen);
    }
    for (const auto& [at, height_at] : chart.ringed)
        svg += ring_at(x.at(at), y.at(height_at));
    if (!chart.ringed.empty()) {
        const double below = legend_line(chart.series.size());
        svg += ring_at(width - right + 29, below - 4);
        svg += text_at(width - right + 54, below, "start", chart.ring_meaning);
    }
    return svg + names.drawn() + "</svg>\n";
}

}  // namespace lightwell
