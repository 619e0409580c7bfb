// What a user waits for: precomputing the sample scenes to an error, and measuring at a thousand
// sensors with a final gather.
#include <random>
#include <string>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "radiance4d/operator/smooth_irradiance.h"
#include "radiance4d/scene/occluder_tree.h"
#include "radiance4d/scene/scene_quads.h"
#include "runtime/outgoing/final_gather.h"
#include "runtime/propagation/lighting.h"
#include "solver/precompute.h"
#include "solver/reading/scene_reader.h"
#include "solver/reference/surface_points.h"
#include "tests/bench/counted_runs.h"

namespace lightwell {
namespace {

Scene scene_named(const std::string& name) {
    return read_scene(std::string(LIGHTWELL_SCENES) + "/" + name + "/scene.toml").scene;
}

/// Counters: what the whole command does, its attempts included. `rays_limit` and
/// `coefficients_limit` are what the scene may cost at this error; the ratios to them stand beside.
void precompute_scene(benchmark::State& state, const std::string& name, double error,
                      double rays_limit, double coefficients_limit) {
    const Scene scene = scene_named(name);
    PrecomputeOptions options;
    options.error = error;
    PrecomputeReport report;
    GlobalTransport transport;
    for (auto _ : state) {
        report = {};
        transport = precompute(scene, options, {}, report);
    }
    double coefficients = 0;
    for (const TransportOperator& channel : transport.indirect)
        coefficients = std::max(coefficients, static_cast<double>(channel.coefficients()));
    state.counters["rays"] = static_cast<double>(transport.provenance.rays);
    state.counters["rays_of_limit"] = static_cast<double>(transport.provenance.rays) / rays_limit;
    state.counters["links"] = static_cast<double>(transport.provenance.links);
    state.counters["coefficients"] = coefficients;
    state.counters["coefs_of_limit"] = coefficients / coefficients_limit;
    state.counters["attempts"] = report.attempts;
    state.counters["error"] = transport.provenance.error_estimated;
    state.counters["error_of_asked"] = transport.provenance.error_estimated / error;
}

/// A thousand sensors on the surfaces of a scene. Counters: rays of the gather, and its time in
/// units of that of solving the light, which has to be done before.
void measure_thousand(benchmark::State& state, const std::string& name) {
    constexpr int sensors = 1000, strata = 64;
    const Scene scene = scene_named(name);
    PrecomputeOptions options;
    options.error = 0.2;
    options.most_attempts = 0;
    PrecomputeReport report;
    const GlobalTransport transport = precompute(scene, options, {}, report);
    const std::vector<Quad> quads = quads_of(scene);
    const Visibility visibility(quads);
    const OccluderTree occluders(quads);
    const std::vector<SurfacePoint> points =
        sample_surface(scene, seeing_sides(scene, visibility), sensors, 1);
    Rgb sum = Rgb::Zero();
    for (auto _ : state) {
        const Lighting lighting =
            light_scene(transport, scene.lights, quads, occluders, Propagation::solved);
        const FinalGather gather(
            transport, visibility,
            smooth_irradiance(transport.space, lighting.direct + lighting.indirect), strata);
        std::vector<Rgb> values(points.size());
        tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t k) {
            values[k] = gather.irradiance(points[k].position, points[k].normal, points[k].quad);
        });
        for (const Rgb& value : values)
            sum += value;
    }
    benchmark::DoNotOptimize(sum);
    state.counters["sensors"] = sensors;
    state.counters["rays"] = static_cast<double>(sensors) * strata * strata;
    state.counters["mean_lux"] = luminance(sum) / sensors / static_cast<double>(state.iterations());
}

/// Rays and coefficients per channel that a scene may take at an error.
struct Limit {
    const char* scene;
    double error;
    double rays;
    double coefficients;
};
constexpr Limit limits[] = {{"cornell-box", 0.05, 0.4e6, 100e3},
                            {"cornell-box", 0.02, 1.2e6, 400e3},
                            {"maze", 0.05, 2e6, 0.6e6}};

}  // namespace
}  // namespace lightwell

int main(int argc, char** argv) {
    using namespace lightwell;
    for (const Limit& limit : limits)
        benchmark::RegisterBenchmark(
            fmt::format("precompute/{}/{}", limit.scene, limit.error).c_str(),
            [&limit](benchmark::State& state) {
                precompute_scene(state, limit.scene, limit.error, limit.rays, limit.coefficients);
            })
            ->Iterations(1)
            ->Unit(benchmark::kSecond)
            ->UseRealTime();
    for (const char* scene : {"cornell-box", "maze"})
        benchmark::RegisterBenchmark(
            fmt::format("measure_1000/{}", scene).c_str(),
            [scene](benchmark::State& state) { measure_thousand(state, scene); })
            ->Unit(benchmark::kSecond)
            ->UseRealTime();
    return run_and_count(argc, argv);
}
