// What a frame with one moved lamp costs, stage by stage, on scenes computed to 5 %.
//
// The scenes are precomputed here, which takes a minute or two, unless LIGHTWELL_BENCH_OPERATORS
// names a folder that holds cornell-box.gto, maze.gto and office.gto.

#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <GL/glcorearb.h>
#include <benchmark/benchmark.h>

#include "radiance4d/operator/light_projection.h"
#include "radiance4d/operator/operator_file.h"
#include "radiance4d/scene/visibility.h"
#include "runtime/drawing/frame_renderer.h"
#include "runtime/drawing/gl_objects.h"
#include "runtime/frame.h"
#include "runtime/projection/fastest_projection.h"
#include "runtime/projection/occlusion_query_projection.h"
#include "runtime/projection/shadow_projection.h"
#include "runtime/propagation/incremental_update.h"
#include "solver/precompute.h"
#include "solver/reading/scene_reader.h"
#include "tests/bench/counted_runs.h"
#include "viewer/offscreen/gl_context.h"

namespace lightwell {

namespace {

struct LitScene {
    GlobalTransport transport;
    std::vector<Quad> quads;
    OccluderTree occluders;

    /// The scene's first lamp, moved by so many centimetres.
    std::vector<Light> lamp(int centimetres) const {
        Light light = transport.scene.lights.at(0);
        std::visit([&](auto& any) { any.position[0] += 0.01 * centimetres; }, light);
        return {light};
    }
    PackedField direct(int centimetres) const {
        return packed(projected_lights(transport.space, lamp(centimetres), quads, occluders));
    }
};

GlobalTransport operator_of(const std::string& name) {
    if (const char* folder = std::getenv("LIGHTWELL_BENCH_OPERATORS")) {
        const std::string file = std::string(folder) + "/" + name + ".gto";
        if (std::filesystem::exists(file)) return read_operator_file(file);
    }
    PrecomputeReport report;
    return precompute(read_scene(LIGHTWELL_SCENES "/" + name + "/scene.toml").scene, {}, {},
                      report);
}

const LitScene& lit_scene(const std::string& name) {
    static std::map<std::string, LitScene> made;
    const auto found = made.find(name);
    if (found != made.end()) return found->second;
    GlobalTransport transport = operator_of(name);
    std::vector<Quad> quads;
    for (const SceneQuad& quad : transport.scene.quads)
        quads.push_back(quad.quad);
    OccluderTree occluders(quads);
    return made.emplace(name, LitScene{std::move(transport), std::move(quads), occluders})
        .first->second;
}

const std::vector<std::string> names = {"cornell-box", "maze", "office"};

// The product H E alone. "bytes" is what the coefficients take, and the rate what that comes to.
void propagation(benchmark::State& state, const std::string& name, ValueFormat format) {
    const LitScene& scene = lit_scene(name);
    const GlobalPropagation held(scene.transport, format);
    const PackedField direct = scene.direct(0);
    PackedField indirect = PackedField::Zero(4, direct.cols());
    std::vector<std::uint32_t> columns;
    for (auto _ : state) {
        held.collect(direct, columns);
        indirect.setZero();
        held.add(columns, direct, indirect);
        benchmark::DoNotOptimize(indirect.data());
    }
    state.counters["columns"] = static_cast<double>(columns.size());
    state.counters["coefficients"] = static_cast<double>(held.coefficients());
    state.counters["bytes"] = static_cast<double>(held.bytes());
    state.SetBytesProcessed(static_cast<std::int64_t>(held.bytes()) * state.iterations());
}

// The same by the operators as the file has them, a channel at a time.
void plain_product(benchmark::State& state, const std::string& name) {
    const LitScene& scene = lit_scene(name);
    const RadianceField direct = unpacked(scene.direct(0));
    for (auto _ : state) {
        const RadianceField light = global_light(scene.transport, direct);
        benchmark::DoNotOptimize(light.data());
    }
}

// A lamp that moves a centimetre a frame, to and fro, updated within a budget (0: none).
void update(benchmark::State& state, const std::string& name, UpdateMode mode) {
    const LitScene& scene = lit_scene(name);
    const GlobalPropagation held(scene.transport);
    std::vector<PackedField> path;
    for (int frame = 0; frame < 8; ++frame)
        path.push_back(scene.direct(frame));
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
    const LitScene& scene = lit_scene(name);
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
    const LitScene& scene = lit_scene(name);
    const std::unique_ptr<GlContext> context = make_offscreen_context();
    OcclusionQueryOptions options;
    options.side = static_cast<int>(state.range(0));
    OcclusionQueryProjection projection(scene.transport.space, scene.quads, context->loader(),
                                        options);
    PackedField direct = PackedField::Zero(4, scene.transport.space.functions());
    int frame = 0;
    for (auto _ : state)
        projection.project(scene.lamp(frame++ % 20), direct);
    state.counters["queries"] = static_cast<double>(projection.queries());
}

void exact_projection(benchmark::State& state, const std::string& name) {
    const LitScene& scene = lit_scene(name);
    int frame = 0;
    for (auto _ : state) {
        const PackedField direct = scene.direct(frame++ % 20);
        benchmark::DoNotOptimize(direct.data());
    }
}

// What a single ray to the middle of every cell that faces the lamp costs, on one thread.
void ray_per_cell(benchmark::State& state, const std::string& name) {
    const LitScene& scene = lit_scene(name);
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

// All that a moved lamp costs before drawing; the stages' shares as counters, mean milliseconds.
void whole_frame(benchmark::State& state, const std::string& name) {
    const LitScene& scene = lit_scene(name);
    Frame frame(scene.transport, std::make_unique<ShadowProjection>(scene.transport.space,
                                                                    scene.quads, scene.occluders));
    double projection = 0, propagated = 0, synthesis = 0;
    int step = 0;
    for (auto _ : state) {
        const FrameReport& report = frame.light(scene.lamp(step++ % 20));
        projection += report.projection_seconds;
        propagated += report.propagation_seconds;
        synthesis += report.synthesis_seconds;
    }
    const auto mean = [&](double seconds) {
        return benchmark::Counter(1e3 * seconds, benchmark::Counter::kAvgIterations);
    };
    state.counters["projection"] = mean(projection);
    state.counters["propagation"] = mean(propagated);
    state.counters["synthesis"] = mean(synthesis);
    state.counters["texels"] = static_cast<double>(frame.textures().size().columns) *
                               static_cast<double>(frame.textures().size().rows);
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
void drawn_frame(benchmark::State& state, const std::string& name) {
    const LitScene& scene = lit_scene(name);
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
    renderer.draw(camera, {}, width, height);
    double maps = 0, upload = 0, drawing = 0;
    const auto timed = [&](double& sum, const auto& work) {
        const double start = steady_seconds();
        work();
        gl.finish();
        sum += steady_seconds() - start;
    };
    int step = 0;
    for (auto _ : state) {
        const std::vector<Light> lamps = scene.lamp(step++ % 20);
        frame.light(lamps);
        timed(maps, [&] { renderer.set_lights(lamps); });
        timed(upload, [&] { renderer.upload(frame.textures()); });
        timed(drawing, [&] { renderer.draw(camera, {}, width, height); });
    }
    const auto mean = [&](double seconds) {
        return benchmark::Counter(1e3 * seconds, benchmark::Counter::kAvgIterations);
    };
    state.counters["maps"] = mean(maps);
    state.counters["upload"] = mean(upload);
    state.counters["drawing"] = mean(drawing);
}

void register_all() {
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
            [name](benchmark::State& state) { whole_frame(state, name); }));
        in_ms(benchmark::RegisterBenchmark(
                  named("DrawnFrame", name).c_str(),
                  [name](benchmark::State& state) { drawn_frame(state, name); }))
            ->Arg(50)
            ->Arg(100);
        in_ms(benchmark::RegisterBenchmark(
            named("ShadowProjection", name).c_str(),
            [name](benchmark::State& state) { shadow_projection(state, name); }));
        in_ms(benchmark::RegisterBenchmark(
                  named("OcclusionQueryProjection", name).c_str(),
                  [name](benchmark::State& state) { occlusion_query_projection(state, name); }))
            ->Arg(512)
            ->Arg(1024);
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
    lightwell::register_all();
    return lightwell::run_and_count(argc, argv);
}
