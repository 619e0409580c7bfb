#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lightwell {

/// One line of a chart.
struct Series {
    std::string name;                               ///< without commas
    std::vector<std::pair<double, double>> points;  ///< x and y, all > 0, in the order to be joined
    /// By point: ends of the interval in y that it is known to; or empty. Those below the axis end
    /// there.
    std::vector<std::pair<double, double>> spans = {};
    bool is_limit = false;  ///< a bound that nothing can pass: drawn dashed and without points
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
};

/// The chart as an SVG picture.
std::string svg_of(const Chart& chart);

/// The chart as rows of series,x,y under a header of the labels.
std::string csv_of(const Chart& chart);

/// y = factor x^exponent.
struct PowerLaw {
    double factor = 1;
    double exponent = 0;
};

/// Least squares of log y on log x, over at least two different x.
PowerLaw fitted_power(const std::vector<std::pair<double, double>>& points);

}  // namespace lightwell
