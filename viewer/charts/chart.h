#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lightwell {

/// How a series is told apart: one look of each kind, counted from 0 and again from the start where
/// there are no more.
struct SeriesLook {
    int colour = 0;
    int form = 0;  ///< of dashes and of markers
};

/// One line of a chart.
struct Series {
    std::string name;
    std::vector<std::pair<double, double>> points;  ///< x and y, all > 0, in the order to be joined
    /// By point: ends of the interval in y that it is known to; or empty. One that leaves the axis
    /// ends there in an arrow.
    std::vector<std::pair<double, double>> spans = {};
    std::vector<std::string> labels = {};  ///< by point: what it is; or empty
    /// By default the next one in the chart.
    std::optional<SeriesLook> look = {};
    bool is_joined = true;      ///< by a line
    bool shows_labels = false;  ///< whether labels are drawn, too
    bool is_limit = false;      ///< a bound: drawn grey, dashed, and without points
};

/// Numbers drawn one against the other, both axes logarithmic.
struct Chart {
    std::string title;
    std::string x_label;
    std::string y_label;
    std::vector<Series> series;  ///< at least one point among them
    /// Points to be ringed, and what that means; or empty.
    std::vector<std::pair<double, double>> ringed = {};
    std::string ring_meaning = {};
    bool x_counts = false;  ///< whether x counts something from 1 on: a linear axis
};

/// The chart as an SVG picture.
std::string svg_of(const Chart& chart);

/// The chart as rows of series,x,y under a header of the labels. Where any series has intervals or
/// labels, or points are ringed, the columns low, high, setting and ringed follow.
std::string csv_of(const Chart& chart);

/// Text as a field of CSV: in quotes where it must be.
std::string csv_field(const std::string& text);

/// y = factor x^exponent.
struct PowerLaw {
    double factor = 1;
    double exponent = 0;
};

/// Least squares of log y on log x, over at least two different x.
PowerLaw fitted_power(const std::vector<std::pair<double, double>>& points);

}  // namespace lightwell
