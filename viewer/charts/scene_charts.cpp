#include "viewer/charts/scene_charts.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace lightwell {

namespace {

constexpr const char* error_label = "relative error of indirect irradiance [%]";

double precompute_time(const MeasuredSetting& s) {
    return s.precompute_seconds;
}
double rays(const MeasuredSetting& s) {
    return static_cast<double>(s.rays);
}
double coefficients(const MeasuredSetting& s) {
    return static_cast<double>(s.coefficients);
}
double mebibytes(const MeasuredSetting& s) {
    return static_cast<double>(s.bytes) / 1048576;
}
double frame_time(const MeasuredSetting& s) {
    return s.frame_milliseconds;
}

NamedChart against(const std::string& name, const std::string& scene, const std::string& what,
                   const std::string& label, const SceneSweep& sweep, const Cost& cost,
                   const std::string& caption) {
    NamedChart named{name,
                     {scene + ": error against " + what, label, error_label,
                      series_by_method(sweep.settings, cost)},
                     caption};
    for (const MeasuredSetting& s : cheapest(sweep.settings, cost))
        named.chart.ringed.emplace_back(cost(s), 100 * s.error.value);
    named.chart.ring_meaning = "cheapest for its error";
    return named;
}

bool has_points(const Chart& chart) {
    return std::any_of(chart.series.begin(), chart.series.end(),
                       [](const Series& series) { return !series.points.empty(); });
}

std::string number(double value) {
    return value > 0 ? fmt::format("{:.3g}", value) : "-";
}

std::vector<std::string> row_of(const MeasuredSetting& s) {
    return {s.method,
            s.setting,
            fmt::format("{:.2f} ({:.2f} to {:.2f})", 100 * s.error.value, 100 * s.error.low,
                        100 * s.error.high),
            number(s.precompute_seconds),
            number(static_cast<double>(s.rays)),
            number(static_cast<double>(s.coefficients)),
            number(mebibytes(s)),
            number(s.frame_milliseconds)};
}

PageTable table_of(const std::string& title, const std::vector<MeasuredSetting>& settings) {
    PageTable table;
    table.title = title;
    table.head = {"method", "setting",      "error [%]", "precompute [s]",
                  "rays",   "coefficients", "MiB",       "frame [ms]"};
    for (const MeasuredSetting& s : settings)
        table.rows.push_back(row_of(s));
    return table;
}

}  // namespace

std::vector<NamedChart> charts_of(const SceneSweep& sweep, const std::string& scene) {
    std::vector<NamedChart> charts;
    charts.push_back(against("error-precompute", scene, "precompute time",
                             "time to precompute [s], on this machine as it was loaded", sweep,
                             precompute_time,
                             "Time to precompute, without reading, judging and writing."));
    charts.push_back(against("error-rays", scene, "rays", "rays of the precomputation", sweep, rays,
                             "Rays traced to precompute, which mean the same on every machine."));
    charts.push_back(against(
        "error-coefficients", scene, "coefficients", "stored coefficients", sweep, coefficients,
        "Coefficients that are stored, of all channels: the gathered operator "
        "needs T and G, the others one of them. No choice of coefficients of G for these "
        "lamps does better than the dashed line without gathering."));
    if (!sweep.truncation.best_by_size.points.empty())
        charts.back().chart.series.push_back(sweep.truncation.best_by_size);
    charts.push_back(against("error-memory", scene, "memory (WRT figure 8)",
                             "size of the file [MiB]", sweep, mebibytes,
                             "Size of the file with what each method needs of it."));
    charts.push_back(
        against("error-frame", scene, "frame time", "time to light a frame anew [ms], one lamp",
                sweep, frame_time,
                "Projection of the lamp, propagation and synthesis of all textures, as "
                "median over lamps; path tracing estimates every texel anew with as "
                "many paths as the error asks for."));

    const TruncationStudy& study = sweep.truncation;
    charts.push_back(
        {"gathered",
         {scene + ": GTO and gathered GTO (WRT figure 4)",
          "coefficients of G",
          error_label,
          {study.global_by_size, study.gathered_by_size, study.best_by_size}},
         "One more bounce at full resolution makes up for most of what truncation took "
         "from G. The dashed line is the best choice of N coefficients of G for the "
         "lamps that judge: no oracle or threshold can do better without gathering."});
    charts.push_back(
        {"powers",
         {scene + ": coefficients of each bounce (WRT figure 6)", "bounce n", "coefficients of T^n",
          study.coefficients_of_powers},
         "Coefficients of T to the power of n that are left above a threshold. Those between "
         "whole sides are never dropped, which is where the curves end."});
    charts.push_back({"thresholds",
                      {scene + ": error of the GTO (WRT figure 7)",
                       "threshold of truncation",
                       error_label,
                       {study.error_of_global, study.error_of_gathered}},
                      "Error of indirect irradiance against the threshold of truncation, which is "
                      "relative to the light that a lamp can be expected to make."});
    charts.erase(std::remove_if(charts.begin(), charts.end(),
                                [](const NamedChart& one) { return !has_points(one.chart); }),
                 charts.end());
    return charts;
}

ChartPage page_of(const SceneSweep& sweep, const std::vector<NamedChart>& charts,
                  const std::string& scene) {
    ChartPage page;
    page.title = "Accuracy against cost: " + scene;
    page.paragraphs = sweep.remarks;
    for (const NamedChart& one : charts)
        page.pictures.emplace_back(svg_of(one.chart), one.caption);
    page.tables.push_back(table_of("The cheapest precomputation for each error",
                                   cheapest(sweep.settings, precompute_time)));
    page.tables.push_back(
        table_of("The cheapest frame for each error", cheapest(sweep.settings, frame_time)));
    page.tables.push_back(table_of("All settings", sweep.settings));
    return page;
}

}  // namespace lightwell
