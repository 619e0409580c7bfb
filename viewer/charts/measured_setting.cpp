#include "viewer/charts/measured_setting.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace lightwell {

namespace {

std::string field(double cost) {
    return cost > 0 ? fmt::format("{:.6g}", cost) : "";
}

std::string field(std::uint64_t cost) {
    return cost > 0 ? fmt::format("{}", cost) : "";
}

bool is_measured(const MeasuredSetting& setting, const Cost& cost) {
    return cost(setting) > 0 && setting.error.value > 0;
}

}  // namespace

std::string csv_of(const std::vector<MeasuredSetting>& settings) {
    std::string csv =
        "method,setting,error,error_low,error_high,error_of_worst_lamp,cells,precompute_seconds,"
        "rays,coefficients,bytes,frame_milliseconds\n";
    for (const MeasuredSetting& s : settings)
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(s.method),
                           csv_field(s.setting), field(s.error.value), field(s.error.low),
                           field(s.error.high), field(s.worst_lamp), field(s.cells),
                           field(s.precompute_seconds), field(s.rays), field(s.coefficients),
                           field(s.bytes), field(s.frame_milliseconds));
    return csv;
}

std::vector<Series> series_by_method(const std::vector<MeasuredSetting>& settings,
                                     const Cost& cost) {
    std::vector<Series> all;
    for (const MeasuredSetting& s : settings) {
        if (!is_measured(s, cost)) continue;
        auto series = std::find_if(all.begin(), all.end(),
                                   [&](const Series& one) { return one.name == s.method; });
        if (series == all.end()) {
            Series first;
            first.name = s.method;
            first.look = s.look;
            first.is_joined = s.is_one_of_a_line;
            first.shows_labels = !s.is_one_of_a_line;
            all.push_back(first);
            series = all.end() - 1;
        }
        series->points.emplace_back(cost(s), 100 * s.error.value);
        series->spans.emplace_back(100 * s.error.low, 100 * s.error.high);
        series->labels.push_back(s.setting);
    }
    return all;
}

std::vector<MeasuredSetting> cheapest(const std::vector<MeasuredSetting>& settings,
                                      const Cost& cost) {
    std::vector<MeasuredSetting> by_cost;
    std::copy_if(settings.begin(), settings.end(), std::back_inserter(by_cost),
                 [&](const MeasuredSetting& s) { return is_measured(s, cost); });
    const auto key = [&](const MeasuredSetting& s) { return std::pair(cost(s), s.error.value); };
    std::stable_sort(
        by_cost.begin(), by_cost.end(),
        [&](const MeasuredSetting& a, const MeasuredSetting& b) { return key(a) < key(b); });
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
