#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "solver/reference/confidence.h"
#include "viewer/charts/chart.h"

namespace lightwell {

/// What one way to compute and to show light came to at one setting. A cost that it does not have,
/// or that is not measured, is 0.
struct MeasuredSetting {
    std::string method;
    std::string setting;      ///< in words: "asked 5 %"
    Interval error;           ///< relative L2 of indirect irradiance (see ErrorSize)
    double worst_lamp = 0;    ///< the same for the lamp with the largest
    std::uint64_t cells = 0;  ///< finest cells of the surfaces
    double precompute_seconds = 0;
    std::uint64_t rays = 0;          ///< of the precomputation
    std::uint64_t coefficients = 0;  ///< that are stored: T once, G of every channel
    std::uint64_t bytes = 0;         ///< that they take in a file
    double frame_milliseconds = 0;   ///< to light the scene anew
    SeriesLook look = {};            ///< of the method
    bool is_one_of_a_line = true;    ///< whether settings of the method follow from each other
};

/// All of them as rows under a header; errors as fractions of one, costs of 0 left empty.
std::string csv_of(const std::vector<MeasuredSetting>& settings);

/// A cost of a setting; 0 where it has none.
using Cost = std::function<double(const MeasuredSetting&)>;

/// Error [%] against a cost, one series a method in the order of their first appearance; settings
/// without that cost or without an error are left out.
std::vector<Series> series_by_method(const std::vector<MeasuredSetting>& settings,
                                     const Cost& cost);

/// Those settings to which no other is both cheaper and as accurate, nor as cheap and more
/// accurate, from the cheapest on.
std::vector<MeasuredSetting> cheapest(const std::vector<MeasuredSetting>& settings,
                                      const Cost& cost);

}  // namespace lightwell
