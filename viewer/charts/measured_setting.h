#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "solver/reference/confidence.h"
#include "viewer/charts/chart.h"

namespace lightwell {

/// What one way to compute and to show light came to at one setting.
struct MeasuredSetting {
    std::string method;              ///< without commas
    std::string setting;             ///< in words, without commas: "error 0.05"
    Interval error;                  ///< relative L2 of indirect irradiance (see ErrorSize)
    double precompute_seconds = 0;   ///< 0: needs none
    std::uint64_t rays = 0;          ///< of the precomputation
    std::uint64_t coefficients = 0;  ///< that are stored
    std::uint64_t bytes = 0;         ///< that they take
    double frame_milliseconds = 0;   ///< to light the scene anew; 0: not measured
};

/// All of them as rows under a header.
std::string csv_of(const std::vector<MeasuredSetting>& settings);

/// A cost of a setting; 0 where it has none.
using Cost = std::function<double(const MeasuredSetting&)>;

/// Error [%] against a cost, one series a method in the order of their first appearance; settings
/// without that cost or without an error are left out.
std::vector<Series> series_by_method(const std::vector<MeasuredSetting>& settings,
                                     const Cost& cost);

/// Those settings to which no other is both cheaper and as accurate: the cheapest for their error.
std::vector<MeasuredSetting> cheapest(const std::vector<MeasuredSetting>& settings,
                                      const Cost& cost);

}  // namespace lightwell
