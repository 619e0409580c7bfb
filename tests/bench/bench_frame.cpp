// What a frame with one moved lamp costs, stage by stage, on scenes computed to 5 %.
//
// The scenes are precomputed here, which takes a minute or two, unless LIGHTWELL_BENCH_OPERATORS
// names a folder that holds NAME.gto of each.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include <GL/glcorearb.h>
#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "radiance4d/operator/light_projection.h"
#include "radiance4d/scene/visibility.h"
#include "runtime/drawing/frame_renderer.h"
#include "runtime/drawing/gl_objects.h"
#include "runtime/frame.h"
#include "runtime/projection/fastest_projection.h"
#include "runtime/projection/occlusion_query_projection.h"
#include "runtime/projection/shadow_projection.h"
#include "runtime/propagation/fitting_format.h"
#include "runtime/propagation/incremental_update.h"
#include "tests/bench/bench_scenes.h"
#include "tests/bench/counted_runs.h"
#include "viewer/offscreen/gl_context.h"

namespace lightwell {

namespace {

const std::vector<std::string> names = {"cornell-box", "maze", "office", "glossy"};

PackedField direct_light(const BenchScene& scene, int centimetres) {
    return packed(projected_lights(scene.transport.space, scene.lamp(centimetres), scene.quads,
                                   scene.occluders));
}

double median(std::vector<double> all) {
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
}

/// Bytes a second at which this machine reads memory that no cache holds, with all its threads.
double memory_bandwidth() {
    static const double bandwidth = [] {
        const std::vector<double> field(std::size_t{1} << 25, 1.0);  // 256 MiB
        std::vector<double> seconds;
        for (int k = 0; k < 5; ++k) {
            const double start = steady_seconds();
            const double sum = tbb::parallel_reduce(
                tbb::blocked_range<std::size_t>(0, field.size(), std::size_t{1} << 16), 0.0,
                [&](const tbb::blocked_range<std::size_t>& range, double part) {
                    std::array<double, 8> lanes = {};
                    for (std::size_t i = range.begin(); i < range.end(); i += lanes.size())
                        for (std::size_t l = 0; l < lanes.size(); ++l)
                            lanes[l] += field[i + l];
                    return std::accumulate(lanes.begin(), lanes.end(), part);
                },
                std::plus<>());
            benchmark::DoNotOptimize(sum);
            seconds.push_back(steady_seconds() - start);
        }
        return static_cast<double>(field.size() * sizeof(double)) / median(seconds);
    }();
    return bandwidth;
}

/// The share of H's coefficients that stand in these columns.
double share_of(const GlobalTransport& transport, const std::vector<std::uint32_t>& columns) {
    double read = 0, all = 0;
    for (const TransportOperator& channel : transport.indirect) {
        all += static_cast<double>(channel.row.size());
        for (const std::uint32_t j : columns)
            read += static_cast<double>(channel.column_start[j + 1] - channel.column_start[j]);
    }
    return read / all;
}

// The product H E alone: its median in ms, and the bytes of coefficients that it reads, as a share
// of what this machine's memory could give in that time. More than 1 is the work of the cache.
void propagation(benchmark::State& state, const std::string& name, ValueFormat format) {
    const BenchScene& scene = bench_scene(name);
    const GlobalPropagation held(scene.transport, format);
    const PackedField direct = direct_light(scene, 0);
    PackedField indirect = PackedField::Zero(4, direct.cols());
    std::vector<std::uint32_t> columns;
    std::vector<double> seconds;
    for (auto _ : state) {
        const double start = steady_seconds();
        held.collect(direct, columns);
        indirect.setZero();
        held.add(columns, direct, indirect);
        benchmark::DoNotOptimize(indirect.data());
        seconds.push_back(steady_seconds() - start);
    }
    const GlobalPropagation exact(scene.transport);
    PackedField unrounded = indirect;
    exact.apply(direct, unrounded);
    state.counters["rounded by %"] =
        100 *
        static_cast<double>((indirect - unrounded).matrix().norm() / unrounded.matrix().norm());
    state.counters["expected %"] = 100 * rounding_of(scene.transport, format);
    const double bytes = share_of(scene.transport, columns) * static_cast<double>(held.bytes());
    state.counters["columns"] = static_cast<double>(columns.size());
    state.counters["coefficients"] = static_cast<double>(held.coefficients());
    state.counters["bytes read"] = bytes;
    state.counters["median ms"] = 1e3 * median(seconds);
    state.counters["of memory's rate"] = bytes / median(seconds) / memory_bandwidth();
}

// The same by the operators as the file has them, a channel at a time.
void plain_product(benchmark::State& state, const std::string& name) {
    const BenchScene& scene = bench_scene(name);
    const RadianceField direct = unpacked(direct_light(scene, 0));
    for (auto _ : state) {
        const RadianceField light = global_light(scene.transport, direct);
        benchmark::DoNotOptimize(light.data());
    }
}

// A lamp that moves a centimetre a frame, to and fro, updated within a budget (0: none).
void update(benchmark::State& state, const std::string& name, UpdateMode mode) {
    const BenchScene& scene = bench_scene(name);
    const GlobalPropagation held(scene.transport);
    std::vector<PackedField> path;
    for (int frame = 0; frame < 8; ++frame)
        path.push_back(direct_light(scene, frame));
    IncrementalUpdate updated(scene.transport.space, held);
    UpdateOptions options;
    options.mode = mode;
    options.budget = static_cast<std::uint32_t>(state.range(0));
    std::size_t frame = 0;
    for (auto _ : state) {
        const std::size_t step = frame++ % 14;
        updated.update(path[step < 8 ? step : 14 - step], options);
        benchmark::DoNotOptimize(updated.indirect().data());
    }
}

// The lamp on the basis, moving.
void shadow_projection(benchmark::State& state, const std::string& name) {
    const BenchScene& scene = bench_scene(name);
    ShadowProjection projection(scene.transport.space, scene.quads, scene.occluders);
    PackedField direct = PackedField::Zero(4, scene.transport.space.functions());
    int frame = 0;
    for (auto _ : state)
        projection.project(scene.lamp(frame++ % 20), direct);
    state.counters["cells"] = static_cast<double>(scene.transport.space.functions());
    state.counters["edge cells"] = static_cast<double>(projection.report().edge_cells);
    state.counters["rays"] = static_cast<double>(projection.report().rays);
}

// By occlusion queries, drawn by the processor (OSMesa).
void occlusion_query_projection(benchmark::State& state, const std::string& name) {
    const BenchScene& scene = bench_scene(name);
    const std::unique_ptr<GlContext> context = make_offscreen_context();
    OcclusionQueryOptions options;
    options.side = static_cast<int>(state.range(0));
    OcclusionQueryProjection projection(scene.transport.space, scene.quads, scene.occluders,
                                        context->loader(), options);
    PackedField direct = PackedField::Zero(4, scene.transport.space.functions());
    int frame = 0;
    for (auto _ : state)
        projection.project(scene.lamp(frame++ % 20), direct);
    state.counters["queries"] = static_cast<double>(projection.queries());
}

// How far the two ways of projection, and either and the exact one, are apart in the flux on a side
// of a quad, of those that receive more than 1e-4 of all; for the scene's lamp in 20 places.
void agreement(benchmark::State& state, const std::string& name) {
    const BenchScene& scene = bench_scene(name);
    const RadianceSpace& space = scene.transport.space;
    const std::unique_ptr<GlContext> context = make_offscreen_context();
    ShadowProjection rays(space, scene.quads, scene.occluders);
    OcclusionQueryProjection queries(space, scene.quads, scene.occluders, context->loader());
    PackedField by_rays = PackedField::Zero(4, space.functions()), by_queries = by_rays;
    // The mean radiance of an element times pi times its area.
    const auto flux = [&](const PackedField& field, const Element& element) {
        return M_PI * std::sqrt(element.space.area({})) *
               static_cast<double>(field(1, element.first));
    };
    double ways = 0, rays_off = 0, queries_off = 0;
    std::size_t sides = 0, far_apart = 0;
    for (auto _ : state)
        for (int place = 0; place < 20; ++place) {
            rays.project(scene.lamp(5 * place), by_rays);
            queries.project(scene.lamp(5 * place), by_queries);
            const PackedField exact = direct_light(scene, 5 * place);
            double all = 0;
            for (const Element& element : space.elements())
                all += flux(exact, element);
            for (const Element& element : space.elements()) {
                const double right = flux(exact, element);
                if (!(right > 1e-4 * all)) continue;
                const double a = flux(by_rays, element), b = flux(by_queries, element);
                ++sides;
                if (std::abs(a - b) > 5e-3 * right) ++far_apart;
                ways = std::max(ways, std::abs(a - b) / right);
                rays_off = std::max(rays_off, std::abs(a - right) / right);
                queries_off = std::max(queries_off, std::abs(b - right) / right);
            }
        }
    state.counters["sides"] = static_cast<double>(sides);
    state.counters["0.5 % apart"] = static_cast<double>(far_apart);
    state.counters["most apart %"] = 100 * ways;
    state.counters["rays off %"] = 100 * rays_off;
    state.counters["queries off %"] = 100 * queries_off;
}

void exact_projection(benchmark::State& state, const std::string& name) {
    const BenchScene& scene = bench_scene(name);
    int frame = 0;
    for (auto _ : state) {
        const PackedField direct = direct_light(scene, frame++ % 20);
        benchmark::DoNotOptimize(direct.data());
    }
}

// What a single ray to the middle of every cell that faces the lamp costs, on one thread.
void ray_per_cell(benchmark::State& state, const std::string& name) {
    const BenchScene& scene = bench_scene(name);
    const Visibility visibility(scene.quads);
    const Vec3 lamp = position_of(scene.lamp(0)[0]);
    std::vector<std::pair<Vec3, int>> middles;
    for (const Element& element : scene.transport.space.elements()) {
        if (!(element.geometry.normal().dot(lamp - element.geometry.centre()) > 0)) continue;
        const CellTree& tree = element.space.tree();
        for (std::uint32_t m = 0; m < tree.functions(); ++m)
            middles.emplace_back(element.cell({tree.levels(), m}).centre(), element.quad);
    }
    for (auto _ : state)
        for (const auto& [middle, quad] : middles)
            benchmark::DoNotOptimize(visibility.occluded(lamp, free_point, middle, quad));
    state.counters["rays"] = static_cast<double>(middles.size());
}

constexpr const char* all_but_drawing = "all before drawing";
/// Median seconds by scene and stage.
using FrameSeconds = std::map<std::string, std::map<std::string, double>>;

// All that a moved lamp costs before drawing: medians of the stages and of their sum.
void whole_frame(benchmark::State& state, const std::string& name, FrameSeconds& known) {
    const BenchScene& scene = bench_scene(name);
    Frame frame(scene.transport, std::make_unique<ShadowProjection>(scene.transport.space,
                                                                    scene.quads, scene.occluders));
    const Vec3 eye = scene.transport.scene.camera.value_or(Camera()).position;
    std::vector<double> projection, propagated, synthesis, all;
    int step = 0;
    for (auto _ : state) {
        FrameReport report = frame.light(scene.lamp(step++ % 20));
        if (frame.is_glossy()) report = frame.look(eye);
        projection.push_back(report.projection_seconds);
        propagated.push_back(report.propagation_seconds);
        synthesis.push_back(report.synthesis_seconds + report.lobe_seconds);
        all.push_back(projection.back() + propagated.back() + synthesis.back());
    }
    // Of several runs the last, longest one counts.
    known[name]["projection"] = median(projection);
    known[name]["GTO"] = median(propagated);
    known[name]["BRDF and synthesis"] = median(synthesis);
    known[name][all_but_drawing] = median(all);
    state.counters["projection ms"] = 1e3 * median(projection);
    state.counters["GTO ms"] = 1e3 * median(propagated);
    state.counters["synthesis ms"] = 1e3 * median(synthesis);
    state.counters["all ms"] = 1e3 * median(all);
    state.counters["texels"] = static_cast<double>(frame.textures().size().columns) *
                               static_cast<double>(frame.textures().size().rows);
}

/// What a moved lamp costs against solving anew, as RenderPark does in 0.14 s at an error of 1.6 %
/// for a Cornell box.
void print_break_even(const FrameSeconds& known) {
    constexpr double solving_anew = 0.14;
    const auto found = known.find("cornell-box");
    if (found == known.end() || found->second.count(all_but_drawing) == 0) return;
    const double frame = found->second.at(all_but_drawing);
    fmt::print(
        "a moved lamp in the Cornell box: {:.2f} ms, {:.0f} times less than solving anew "
        "by RenderPark ({:.2f} s)\n",
        1e3 * frame, solving_anew / frame, solving_anew);
    const double precomputed = precompute_seconds("cornell-box");
    if (precomputed > 0)
        fmt::print("the precomputation of {:.1f} s has paid after {:.0f} moves\n", precomputed,
                   std::ceil(precomputed / (solving_anew - frame)));
}

/// An image for frames, bound while it lives.
class FrameTarget {
  public:
    FrameTarget(const GlFunctions& gl, int width, int height)
        : gl_(gl),
          framebuffer_(make_framebuffer(gl)),
          colours_(make_renderbuffer(gl, GL_RGBA8, width, height)) {
        gl.bind_framebuffer(GL_FRAMEBUFFER, framebuffer_.name());
        gl.framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                    colours_.name());
    }
    ~FrameTarget() { gl_.bind_framebuffer(GL_FRAMEBUFFER, 0); }
    FrameTarget(const FrameTarget&) = delete;
    FrameTarget& operator=(const FrameTarget&) = delete;

  private:
    const GlFunctions& gl_;
    GlObject framebuffer_, colours_;
};

// A frame from a moved lamp to the pixels, drawn by the processor (OSMesa), 960 x 720 unless the
// argument, a percentage of that along a side, says otherwise.
void drawn_frame(benchmark::State& state, const std::string& name, FrameSeconds& known) {
    const BenchScene& scene = bench_scene(name);
    const std::unique_ptr<GlContext> context = make_offscreen_context();
    const GlFunctions gl(context->loader());
    const int width = static_cast<int>(960 * state.range(0) / 100);
    const int height = static_cast<int>(720 * state.range(0) / 100);
    const FrameTarget target(gl, width, height);
    FrameRenderer renderer(scene.transport, context->loader());
    Frame frame(scene.transport, std::make_unique<ShadowProjection>(scene.transport.space,
                                                                    scene.quads, scene.occluders));
    const Camera camera = scene.transport.scene.camera.value_or(Camera());
    // The first frame compiles shaders.
    renderer.set_lights(scene.lamp(0));
    if (frame.is_glossy()) {
        frame.look(camera.position);
        renderer.upload_lobes(frame.lobes(), frame.emitted_lobes());
    }
    renderer.draw(camera, {}, width, height);
    std::vector<double> maps, upload, drawing, all;
    const auto timed = [&](std::vector<double>& seconds, const auto& work) {
        const double start = steady_seconds();
        work();
        gl.finish();
        seconds.push_back(steady_seconds() - start);
    };
    int step = 0;
    for (auto _ : state) {
        const std::vector<Light> lamps = scene.lamp(step++ % 20);
        const double start = steady_seconds();
        frame.light(lamps);
        if (frame.is_glossy()) frame.look(camera.position);
        timed(maps, [&] { renderer.set_lights(lamps); });
        timed(upload, [&] {
            renderer.upload(frame.textures());
            if (frame.is_glossy()) renderer.upload_lobes(frame.lobes(), frame.emitted_lobes());
        });
        timed(drawing, [&] { renderer.draw(camera, {}, width, height); });
        all.push_back(steady_seconds() - start);
    }
    state.counters["maps ms"] = 1e3 * median(maps);
    state.counters["upload ms"] = 1e3 * median(upload);
    state.counters["drawing ms"] = 1e3 * median(drawing);
    state.counters["all ms"] = 1e3 * median(all);
    if (state.range(0) != 100) return;
    known[name]["shadow maps"] = median(maps);
    known[name]["upload"] = median(upload);
    known[name]["drawing"] = median(drawing);
}

/// The stages' medians of all scenes, by their size.
void chart_stages(const FrameSeconds& known) {
    Chart chart{"One frame with a moved lamp", "cells of the scene", "median of a stage (ms)", {}};
    std::map<std::string, Series> by_stage;
    for (const auto& [name, stages] : known)
        for (const auto& [stage, seconds] : stages)
            by_stage[stage].points.emplace_back(bench_scene(name).transport.space.functions(),
                                                1e3 * seconds);
    for (auto& [stage, series] : by_stage) {
        std::sort(series.points.begin(), series.points.end());
        series.name = stage;
        chart.series.push_back(series);
    }
    if (!chart.series.empty()) write_chart("frame", chart);
}

void register_all(FrameSeconds& known) {
    const auto in_ms = [](benchmark::internal::Benchmark* bench) {
        return bench->Unit(benchmark::kMillisecond)->UseRealTime();
    };
    const auto named = [](const std::string& what, const std::string& scene) {
        return what + "/" + scene;
    };
    for (const std::string& name : names) {
        in_ms(benchmark::RegisterBenchmark(
            named("PlainProduct", name).c_str(),
            [name](benchmark::State& state) { plain_product(state, name); }));
        in_ms(benchmark::RegisterBenchmark(
            named("Frame", name).c_str(),
            [name, &known](benchmark::State& state) { whole_frame(state, name, known); }));
        in_ms(benchmark::RegisterBenchmark(
                  named("DrawnFrame", name).c_str(),
                  [name, &known](benchmark::State& state) { drawn_frame(state, name, known); }))
            ->Arg(50)
            ->Arg(100)
            ->Iterations(15);
        in_ms(benchmark::RegisterBenchmark(
            named("ShadowProjection", name).c_str(),
            [name](benchmark::State& state) { shadow_projection(state, name); }));
        in_ms(benchmark::RegisterBenchmark(
                  named("OcclusionQueryProjection", name).c_str(),
                  [name](benchmark::State& state) { occlusion_query_projection(state, name); }))
            ->Arg(512)
            ->Arg(1024);
        in_ms(benchmark::RegisterBenchmark(
                  named("Agreement", name).c_str(),
                  [name](benchmark::State& state) { agreement(state, name); }))
            ->Iterations(1);
        in_ms(benchmark::RegisterBenchmark(
            named("ExactProjection", name).c_str(),
            [name](benchmark::State& state) { exact_projection(state, name); }));
        in_ms(benchmark::RegisterBenchmark(
            named("RayPerCell", name).c_str(),
            [name](benchmark::State& state) { ray_per_cell(state, name); }));
        const std::pair<const char*, ValueFormat> formats[] = {
            {"PropagationSingle", ValueFormat::single},
            {"PropagationHalf", ValueFormat::half},
            {"PropagationByte", ValueFormat::byte}};
        for (const auto& [title, format] : formats)
            in_ms(benchmark::RegisterBenchmark(named(title, name).c_str(),
                                               [name, value = format](benchmark::State& state) {
                                                   propagation(state, name, value);
                                               }));
        const std::pair<const char*, UpdateMode> modes[] = {
            {"UpdateFresh", UpdateMode::fresh},
            {"UpdateIncremental", UpdateMode::incremental},
            {"UpdatePerBand", UpdateMode::per_band}};
        for (const auto& [title, mode] : modes)
            in_ms(benchmark::RegisterBenchmark(
                      named(title, name).c_str(),
                      [name, value = mode](benchmark::State& state) { update(state, name, value); })
                      ->Arg(30)
                      ->Arg(300)
                      ->Arg(0));
    }
}

}  // namespace

}  // namespace lightwell

int main(int argc, char** argv) {
    lightwell::FrameSeconds known;
    lightwell::register_all(known);
    return lightwell::run_and_count(argc, argv, [&known] {
        lightwell::print_break_even(known);
        lightwell::chart_stages(known);
    });
}
