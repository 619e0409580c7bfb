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
    named.chart.ring_meaning = "none is cheaper and as accurate";
    return named;
}

bool has_points(const Chart& chart) {
    return std::any_of(chart.series.begin(), chart.series.end(),
                       [](const Series& series) { return !series.points.empty(); });
}

/// The default's G as it is stored, to compare with a study of another operator.
std::vector<Series> stored_default(const SceneSweep& sweep) {
    std::vector<Series> stored = series_by_method(sweep.settings, coefficients);
    stored.erase(std::remove_if(stored.begin(), stored.end(),
                                [](const Series& one) { return one.name != "default: G stored"; }),
                 stored.end());
    return stored;
}

std::vector<NamedChart> cost_charts(const SceneSweep& sweep, const std::string& scene) {
    const TruncationStudy& study = sweep.truncation;
    std::vector<NamedChart> charts;
    charts.push_back(against("error-precompute", scene, "precompute time",
                             "time to precompute [s] on this machine", sweep, precompute_time,
                             "Time to precompute, without reading and writing: one operator from "
                             "its settings; with its judging, what the command takes until it "
                             "promises the error. Work of less than two seconds is done up to "
                             "three times for the shortest time."));
    charts.push_back(against("error-rays", scene, "rays", "rays of the precomputation", sweep, rays,
                             "Rays traced to precompute, which mean the same on every machine; "
                             "with its judging, those of the judge as well."));
    charts.push_back(against(
        "error-coefficients", scene, "coefficients", "stored coefficients", sweep, coefficients,
        "Coefficients that are stored: T is colourless, and one of each symmetric pair; G has "
        "those of each channel that differs. What is gathered needs T and G, the others one of "
        "them."));
    if (!study.best_by_size.points.empty()) {
        charts.back().chart.series.push_back(study.best_by_size);
        charts.back().caption += fmt::format(
            " Grey: of all coefficients of G between {} cells, solved for without truncation, the "
            "N that weigh most for the very lamps that judge. It is the best choice where errors "
            "of coefficients are independent, which they are nearly: others may come out some per "
            "cent below it. It holds for G stored; what is gathered or iterated has another bounce "
            "of T.",
            study.cells);
    }
    charts.push_back(against("error-memory", scene, "memory (after WRT figure 8)",
                             "size of the file [MiB]", sweep, mebibytes,
                             "Size of the file with what each method needs of it, scene included; "
                             "in the paper, memory of the operator against its own error."));
    charts.push_back(
        against("error-frame", scene, "frame time", "time to light a frame anew [ms], one lamp",
                sweep, frame_time,
                "Projection of a lamp that was not there before, propagation and synthesis of all "
                "textures: of eight lamps the median of the shortest of three times. G is applied "
                "by all threads; T by one, colour by colour, iterated until a step changes the "
                "light by less than a tenth of the error asked for. Path tracing estimates every "
                "cell of the default anew, with as many paths as its error asks for, extrapolated "
                "from the noise and the time of 32."));
    return charts;
}

std::vector<NamedChart> study_charts(const SceneSweep& sweep, const std::string& scene) {
    const TruncationStudy& study = sweep.truncation;
    const std::string rule = fmt::format(
        "{} cells. One threshold for all coefficients and bounces, as in the paper; it is "
        "relative to the light that a lamp can be expected to make.",
        study.cells);
    std::vector<NamedChart> charts;
    charts.push_back(
        {"gathered",
         {scene + ": GTO and gathered GTO (after WRT figure 4)",
          "coefficients of G, all channels",
          error_label,
          {study.global_by_size, study.gathered_by_size}},
         rule +
             " The gathered GTO has one more bounce by T, which is applied at run time and not "
             "counted here; the paper multiplies it out. Beside it the default's own G, of "
             "other cells, whose thresholds are found by trial lights and which keeps more of what "
             "passes between whole sides. Grey as in the chart of coefficients."});
    Chart& gathered = charts.back().chart;
    for (const Series& one : stored_default(sweep)) {
        gathered.series.push_back(one);
        gathered.series.back().look = {3, 2};
    }
    if (!study.best_by_size.points.empty()) gathered.series.push_back(study.best_by_size);
    charts.push_back({"powers",
                      {scene + ": coefficients of each bounce (after WRT figure 6)", "bounce n",
                       "coefficients of T^n, all channels", study.coefficients_of_powers},
                      rule + " Coefficients of T to the power of n that are left when each product "
                             "is truncated."});
    charts.back().chart.x_counts = true;
    charts.push_back(
        {"thresholds",
         {scene + ": error of the GTO (after WRT figure 7)",
          "threshold of truncation",
          error_label,
          {study.judged_global, study.judged_gathered, study.own_global, study.own_gathered,
           study.judged_whole}},
         rule + " Errors as path tracing judges them, which end at that of the whole "
                "operator between these cells; and own errors, against the light that the whole "
                "operator makes, as in the paper."});
    return charts;
}

std::string number(double value) {
    if (!(value > 0)) return "-";
    return value >= 1000 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

std::vector<std::string> row_of(const MeasuredSetting& s) {
    const std::string interval =
        s.error.low < s.error.high
            ? fmt::format("{:.2f} to {:.2f}", 100 * s.error.low, 100 * s.error.high)
            : "-";
    return {s.method,
            s.setting,
            fmt::format("{:.2f}", 100 * s.error.value),
            interval,
            number(100 * s.worst_lamp),
            number(static_cast<double>(s.cells)),
            number(s.precompute_seconds),
            number(static_cast<double>(s.rays)),
            number(static_cast<double>(s.coefficients)),
            number(mebibytes(s)),
            number(s.frame_milliseconds)};
}

PageTable table_of(const std::string& title, const std::vector<MeasuredSetting>& settings) {
    PageTable table;
    table.title = title;
    table.head = {"method",         "setting", "error [%]",    "95 %", "worst lamp [%]", "cells",
                  "precompute [s]", "rays",    "coefficients", "MiB",  "frame [ms]"};
    for (const MeasuredSetting& s : settings)
        table.rows.push_back(row_of(s));
    return table;
}

/// What one changed setting makes of the default: errors and costs over its own.
PageTable variations_table(const SceneSweep& sweep) {
    const MeasuredSetting& of = sweep.unvaried;
    PageTable table;
    table.title = "One setting changed by hand: errors and costs over the default's, " + of.setting;
    table.head = {"changed", "error",        "worst lamp", "precompute",
                  "rays",    "coefficients", "bytes",      "frame"};
    const auto over = [](double changed, double unchanged) {
        return unchanged > 0 ? fmt::format("{:.2f}", changed / unchanged) : "-";
    };
    for (const MeasuredSetting& s : sweep.varied)
        table.rows.push_back(
            {s.setting, over(s.error.value, of.error.value), over(s.worst_lamp, of.worst_lamp),
             over(precompute_time(s), precompute_time(of)), over(rays(s), rays(of)),
             over(coefficients(s), coefficients(of)), over(mebibytes(s), mebibytes(of)),
             over(frame_time(s), frame_time(of))});
    return table;
}

/// Whether the default is the knee.
std::string verdict(const SceneSweep& sweep) {
    const MeasuredSetting& of = sweep.unvaried;
    std::string better;
    for (const MeasuredSetting& s : sweep.varied)
        if (s.error.value <= of.error.value && s.precompute_seconds <= of.precompute_seconds &&
            s.coefficients <= of.coefficients)
            better += (better.empty() ? "" : ", ") + s.setting;
    const std::string what =
        fmt::format("Of six changes of the default ({}) by hand, ", of.setting);
    if (better.empty())
        return what + "none is at once as accurate, as fast and as small: it is the knee.";
    return what + fmt::format(
                      "these are at once as accurate, as fast and as small: {}. Errors here "
                      "are averages over lamps anywhere; the default also has to keep "
                      "lamps close to walls, for which cells must be finer (the column of "
                      "the worst lamp says what that comes to here).",
                      better);
}

PageTable methods_table() {
    return {"Methods",
            {"name", "what it is"},
            {{"default",
              "the geometric oracle of Lightwell, with the cells, tolerances and "
              "truncation that follow from the error asked for"},
             {"default by hand",
              "the same with one of these changed; where it is the cells, they are the same "
              "everywhere, without finer ones in narrow gaps or on glossy sides"},
             {"paper's oracle",
              "the oracle of WRT section 4.1, which goes by 32 samples a link and "
              "stops where they differ by less than its threshold, over the "
              "default's cells and truncation"},
             {"compute and compress",
              "no oracle: all pairs of finest cells are computed, and "
              "coefficients left out afterwards"},
             {"gathered", "T (E + H E): one last bounce at full resolution, as pictures show it"},
             {"G stored",
              "H E: the stored global transport operator alone, as a moving lamp shows "
              "it"},
             {"T iterated", "T E + T T E + ... at run time, without G"}}};
}

}  // namespace

std::vector<NamedChart> charts_of(const SceneSweep& sweep, const std::string& scene) {
    std::vector<NamedChart> charts = cost_charts(sweep, scene);
    for (NamedChart& one : study_charts(sweep, scene))
        charts.push_back(std::move(one));
    charts.erase(std::remove_if(charts.begin(), charts.end(),
                                [](const NamedChart& one) { return !has_points(one.chart); }),
                 charts.end());
    return charts;
}

ChartPage page_of(const SceneSweep& sweep, const std::vector<NamedChart>& charts,
                  const std::string& scene, const std::string& made_with) {
    ChartPage page;
    page.title = "Accuracy against cost: " + scene;
    page.paragraphs.push_back(made_with);
    page.paragraphs.insert(page.paragraphs.end(), sweep.remarks.begin(), sweep.remarks.end());
    page.paragraphs.push_back(verdict(sweep));
    for (const NamedChart& one : charts)
        page.pictures.emplace_back(svg_of(one.chart), one.caption);
    page.tables.push_back(methods_table());
    page.tables.push_back(variations_table(sweep));
    page.tables.push_back(table_of("The cheapest precomputation for each error",
                                   cheapest(sweep.settings, precompute_time)));
    page.tables.push_back(
        table_of("The fewest coefficients for each error", cheapest(sweep.settings, coefficients)));
    page.tables.push_back(
        table_of("The cheapest frame for each error", cheapest(sweep.settings, frame_time)));
    page.tables.push_back(table_of("All settings", sweep.settings));
    return page;
}

}  // namespace lightwell
