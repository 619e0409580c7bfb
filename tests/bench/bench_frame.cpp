// What a frame with one moved lamp costs, stage by stage, on scenes computed to 5 %.
//
// The scenes are precomputed here, which takes a minute or two, unless LIGHTWELL_BENCH_OPERATORS
// names a folder that holds NAME.gto of each.

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <GL/glcorearb.h>
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include "runtime/drawing/frame_renderer.h"
#include "runtime/drawing/gl_objects.h"
#include "runtime/frame.h"
#include "runtime/projection/fastest_projection.h"
#include "runtime/projection/shadow_projection.h"
#include "tests/bench/bench_scenes.h"
#include "tests/bench/counted_runs.h"
#include "tests/bench/frame_stages.h"
#include "viewer/offscreen/gl_context.h"

namespace lightwell {

namespace {

const std::vector<std::string> names = {"cornell-box", "maze", "office", "glossy"};

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
    Chart chart{"One frame with a moved lamp", "cells of the scene:", "median of a stage (ms)", {}};
    std::map<std::uint32_t, std::string> by_cells;
    for (const auto& measured : known)
        by_cells[bench_scene(measured.first).transport.space.functions()] = measured.first;
    for (const auto& [cells, name] : by_cells)
        chart.x_label += fmt::format(" {} {};", name, cells);
    chart.x_label.pop_back();
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
    for (const std::string& name : names) {
        stage_benchmark("Frame", name, [name, &known](benchmark::State& state) {
            whole_frame(state, name, known);
        });
        stage_benchmark(
            "DrawnFrame", name,
            [name, &known](benchmark::State& state) { drawn_frame(state, name, known); })
            ->Arg(50)
            ->Arg(100)
            ->Iterations(15);
    }
    register_projection(names);
    register_propagation(names);
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
