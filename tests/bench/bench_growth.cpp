// How the cost of a precomputation grows with the number of quads: crops of one scene, 1 m squares
// each, from small to large, with cells of the same size in all of them.
//
// The crops lie outside the project, in the folder that LIGHTWELL_SHARED names, or else beside it.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "solver/precompute.h"
#include "solver/reading/scene_reader.h"
#include "tests/bench/counted_runs.h"

namespace lightwell {
namespace {

struct Crop {
    std::string path;
    Scene scene;
};

/// The crops that are not packed, in ascending order of quads, up to `most_quads`.
std::vector<Crop> crops(std::size_t most_quads) {
    const char* shared = std::getenv("LIGHTWELL_SHARED");
    const std::filesystem::path folder =
        std::filesystem::path(shared != nullptr ? shared : LIGHTWELL_SHARED_DEFAULT) /
        "scenes/lost-empire";
    std::vector<Crop> found;
    if (!std::filesystem::is_directory(folder)) {
        std::cout << "no " << folder.string() << ": growth is not measured\n";
        return found;
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".obj") continue;
        Crop crop{entry.path().string(), read_scene(entry.path().string()).scene};
        if (crop.scene.quads.size() <= most_quads) found.push_back(std::move(crop));
    }
    std::sort(found.begin(), found.end(), [](const Crop& a, const Crop& b) {
        return a.scene.quads.size() < b.scene.quads.size();
    });
    return found;
}

/// Every count and every stage's seconds against quads.
using Costs = std::map<std::string, Series>;

void run(benchmark::State& state, const Crop& crop, Costs& costs) {
    PrecomputeOptions options;
    options.error = 0.2;
    options.cell_size = 0.5;  // four cells a quad
    options.most_attempts = 0;
    PrecomputeReport report;
    GlobalTransport transport;
    for (auto _ : state)
        transport = precompute(crop.scene, options, {}, report);
    const auto quads = static_cast<double>(crop.scene.quads.size());
    const auto note = [&](const std::string& name, double value) {
        if (!(value > 0)) return;
        costs[name].name = name;
        costs[name].points.emplace_back(quads, value);
    };
    state.counters["quads"] = quads;
    const std::map<std::string, std::uint64_t> counts = {
        {"rays", transport.provenance.rays},
        {"links", transport.provenance.links},
        {"T_coefficients", transport.bounce.coefficients()},
        {"G_coefficients", transport.indirect[0].coefficients()}};
    for (const auto& [name, count] : counts) {
        state.counters[name] = static_cast<double>(count);
        note(name, static_cast<double>(count));
    }
    for (const auto& [stage, seconds] : report.seconds) {
        if (stage == "other") continue;
        state.counters["s_" + stage] = seconds;
        note("seconds " + stage, seconds);
    }
}

void print_exponents(const Costs& costs) {
    std::cout << "\ncost = factor x quads^exponent, by least squares of the logarithms:\n";
    for (const auto& [name, series] : costs) {
        if (series.points.size() < 2) continue;
        const PowerLaw law = fitted_power(series.points);
        std::cout << fmt::format("  {:<18} exponent {:5.2f}  factor {:.3g}\n", name, law.exponent,
                                 law.factor);
    }
}

Chart chart_of(const Costs& costs) {
    Chart chart{"Lost Empire: cost against quads", "quads", "count", {}};
    for (const char* name : {"rays", "links", "T_coefficients", "G_coefficients"})
        chart.series.push_back(costs.at(name));
    return chart;
}

}  // namespace
}  // namespace lightwell

int main(int argc, char** argv) {
    using namespace lightwell;
    constexpr std::size_t most_quads = 1500;
    const std::vector<Crop> all = crops(most_quads);
    Costs costs;
    for (const Crop& crop : all)
        benchmark::RegisterBenchmark(
            fmt::format("lost_empire/{}", crop.scene.quads.size()).c_str(),
            [&crop, &costs](benchmark::State& state) { run(state, crop, costs); })
            ->Iterations(1)
            ->Unit(benchmark::kSecond)
            ->UseRealTime();
    if (all.empty()) return 0;
    return run_and_count(argc, argv, [&costs] {
        print_exponents(costs);
        write_chart("growth", chart_of(costs));
    });
}
