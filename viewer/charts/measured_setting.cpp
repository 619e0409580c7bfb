#include "viewer/charts/measured_setting.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace lightwell {

std::string csv_of(const std::vector<MeasuredSetting>& settings) {
    std::string csv =
        "method,setting,error,error_low,error_high,precompute_seconds,rays,coefficients,bytes,"
        "frame_milliseconds\n";
    for (const MeasuredSetting& s : settings)
        csv +=
            fmt::format("{},{},{:.6g},{:.6g},{:.6g},{:.6g},{},{},{},{:.6g}\n", s.method, s.setting,
                        s.error.value, s.error.low, s.error.high, s.precompute_seconds, s.rays,
                        s.coefficients, s.bytes, s.frame_milliseconds);
    return csv;
}

std::vector<Series> series_by_method(const std::vector<MeasuredSetting>& settings,
                                     const Cost& cost) {
    std::vector<Series> all;
    for (const MeasuredSetting& s : settings) {
        if (!(cost(s) > 0 && s.error.value > 0)) continue;
        auto series = std::find_if(all.begin(), all.end(),
                                   [&](const Series& one) { return one.name == s.method; });
        if (series == all.end()) {
            all.push_back({s.method, {}});
            series = all.end() - 1;
        }
        series->points.emplace_back(cost(s), 100 * s.error.value);
        series->spans.emplace_back(100 * s.error.low, 100 * s.error.high);
    }
    return all;
}

std::vector<MeasuredSetting> cheapest(const std::vector<MeasuredSetting>& settings,
                                      const Cost& cost) {
    std::vector<MeasuredSetting> by_cost;
    for (const MeasuredSetting& s : settings)
        if (cost(s) > 0 && s.error.value > 0) by_cost.push_back(s);
    std::stable_sort(
        by_cost.begin(), by_cost.end(),
        [&](const MeasuredSetting& a, const MeasuredSetting& b) { return cost(a) < cost(b); });
    double best = std::numeric_limits<double>::infinity();
    std::vector<MeasuredSetting> front;
    for (const MeasuredSetting& s : by_cost) {
        if (s.error.value >= best) continue;
        best = s.error.value;
        front.push_back(s);
    }
    return front;
}

}  // namespace lightwell
