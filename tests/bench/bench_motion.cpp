// How accurate X stays while a lamp moves and only some coefficients of E are multiplied a frame:
// fresh products, incremental updates and per-band incremental updates (Overbeck et al. 2006,
// figure 7), on three paths in each of three scenes, with slow and fast lamps.
//
// "error" is the relative distance of X to the exact product, root mean square over all frames of
// all paths; "worst" the largest. "rest" is the error ten frames after the lamp has stopped.

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "runtime/projection/shadow_projection.h"
#include "runtime/propagation/incremental_update.h"
#include "tests/bench/bench_scenes.h"
#include "tests/bench/counted_runs.h"

namespace lightwell {

namespace {

constexpr int path_frames = 100, paths = 3;
const std::vector<std::string> scenes = {"cornell-box", "maze", "office"};

/// To and fro between 0 and 1.
double there_and_back(double way) {
    return std::abs(std::remainder(way, 2.0));
}

/// Where the lamp has got to from its place in the scene [m], which is in free air half a metre
/// all round: along a line, on a circle, or to and fro with a rest after every three steps.
Vec3 moved(int path, int frame, double step) {
    const double way = step * frame;
    switch (path) {
        case 0:
            return 0.5 * there_and_back(way / 0.5) * Vec3(0.8, -0.5, -0.33);
        case 1:
            return 0.3 * Vec3(std::cos(way / 0.3) - 1, std::sin(way / 0.3), 0);
        default:
            return 0.4 * there_and_back(step * (frame - frame / 4) / 0.4) * Vec3(-0.7, 0.7, -0.1);
    }
}

struct Motion {
    std::vector<PackedField> direct, indirect;
};

/// E and the exact X of every frame.
const Motion& motion(const std::string& name, int path, int centimetres,
                     const GlobalPropagation& held) {
    static std::map<std::string, Motion> known;
    Motion& made = known[fmt::format("{} {} {}", name, path, centimetres)];
    if (!made.direct.empty()) return made;
    const BenchScene& scene = bench_scene(name);
    ShadowProjection projection(scene.transport.space, scene.quads, scene.occluders);
    PackedField field = PackedField::Zero(4, scene.transport.space.functions());
    for (int frame = 0; frame < path_frames; ++frame) {
        projection.project(scene.lamp(moved(path, frame, 0.01 * centimetres)), field);
        made.direct.push_back(field);
        held.apply(made.direct.back(), field);
        made.indirect.push_back(field);
    }
    return made;
}

const GlobalPropagation& propagation(const std::string& name) {
    static std::map<std::string, GlobalPropagation> held;
    const auto found = held.find(name);
    if (found != held.end()) return found->second;
    return held.emplace(name, GlobalPropagation(bench_scene(name).transport)).first->second;
}

double relative_distance(const PackedField& a, const PackedField& b) {
    return static_cast<double>((a - b).matrix().norm() / b.matrix().norm());
}

struct Setting {
    std::string scene;
    int centimetres;  ///< a frame
    UpdateMode mode;
    std::uint32_t budget;
};

const char* name_of(UpdateMode mode) {
    return mode == UpdateMode::fresh         ? "fresh"
           : mode == UpdateMode::incremental ? "incremental"
                                             : "per band";
}

/// Error by setting, for the charts.
using Errors = std::map<std::pair<std::string, int>, std::map<std::string, Series>>;

void run(benchmark::State& state, const Setting& setting, Errors& errors) {
    const GlobalPropagation& held = propagation(setting.scene);
    const RadianceSpace& space = bench_scene(setting.scene).transport.space;
    UpdateOptions options;
    options.mode = setting.mode;
    double squares = 0, worst = 0, rest = 0;
    for (auto _ : state)
        for (int path = 0; path < paths; ++path) {
            const Motion& along = motion(setting.scene, path, setting.centimetres, held);
            IncrementalUpdate update(space, held);
            options.budget = 0;
            update.update(along.direct[0], options);
            options.budget = setting.budget;
            for (std::size_t frame = 1; frame < along.direct.size(); ++frame) {
                update.update(along.direct[frame], options);
                const double error = relative_distance(update.indirect(), along.indirect[frame]);
                squares += error * error;
                worst = std::max(worst, error);
            }
            for (int frame = 0; frame < 10; ++frame)
                update.update(along.direct.back(), options);
            rest = std::max(rest, relative_distance(update.indirect(), along.indirect.back()));
        }
    const double error = std::sqrt(squares / (paths * (path_frames - 1)));
    state.counters["error %"] = 100 * error;
    state.counters["worst %"] = 100 * worst;
    state.counters["rest"] = rest;
    errors[{setting.scene, setting.centimetres}][name_of(setting.mode)].points.emplace_back(
        setting.budget, error);
}

void write_charts(const Errors& errors) {
    for (const auto& [what, by_mode] : errors) {
        const auto& [scene, centimetres] = what;
        Chart chart{fmt::format("{}, a lamp that moves {} cm a frame", scene, centimetres),
                    "coefficients multiplied a frame",
                    "relative error of X in motion",
                    {}};
        for (const auto& [mode, series] : by_mode) {
            chart.series.push_back(series);
            chart.series.back().name = mode;
        }
        write_chart(fmt::format("motion-{}-{}cm", scene, centimetres), chart);
    }
}

}  // namespace

}  // namespace lightwell

int main(int argc, char** argv) {
    using namespace lightwell;
    Errors errors;
    for (const std::string& scene : scenes)
        for (const int centimetres : {1, 2, 5})
            for (const UpdateMode mode :
                 {UpdateMode::fresh, UpdateMode::incremental, UpdateMode::per_band})
                for (const std::uint32_t budget : {30u, 100u, 300u})
                    benchmark::RegisterBenchmark(
                        fmt::format("{}/{}cm/{}/{}", scene, centimetres, name_of(mode), budget)
                            .c_str(),
                        [=, &errors](benchmark::State& state) {
                            run(state, {scene, centimetres, mode, budget}, errors);
                        })
                        ->Iterations(1)
                        ->Unit(benchmark::kMillisecond)
                        ->UseRealTime();
    return run_and_count(argc, argv, [&errors] { write_charts(errors); });
}
