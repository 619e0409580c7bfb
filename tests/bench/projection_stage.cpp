// What the projection of a lamp costs, in all ways, and how well they agree.
#include <algorithm>
#include <cmath>
#include <memory>

#include "radiance4d/scene/visibility.h"
#include "runtime/projection/occlusion_query_projection.h"
#include "runtime/projection/shadow_projection.h"
#include "tests/bench/frame_stages.h"
#include "viewer/offscreen/gl_context.h"

namespace lightwell {

namespace {

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

/// Flux on an element [lm], green: its mean radiance times pi times its area.
double flux(const PackedField& field, const Element& element) {
    return M_PI * std::sqrt(element.space.area({})) * static_cast<double>(field(1, element.first));
}

double flux_on_all(const PackedField& field, const RadianceSpace& space) {
    double all = 0;
    for (const Element& element : space.elements())
        all += flux(field, element);
    return all;
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
    double ways = 0, rays_off = 0, queries_off = 0;
    std::size_t sides = 0, far_apart = 0;
    for (auto _ : state)
        for (int place = 0; place < 20; ++place) {
            rays.project(scene.lamp(5 * place), by_rays);
            queries.project(scene.lamp(5 * place), by_queries);
            const PackedField exact = direct_light(scene, 5 * place);
            const double all = flux_on_all(exact, space);
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

// How the error of a way of projection jumps about on any side that receives more than 1e-3 of all,
// while the scene's lamp moves by a centimetre a frame for 200 frames: the second difference of
// (E - E_exact) / E, root mean square over the frames, and the largest single step.
void flicker(benchmark::State& state, const std::string& name, bool by_queries) {
    constexpr int frames = 200;
    const BenchScene& scene = bench_scene(name);
    const RadianceSpace& space = scene.transport.space;
    const std::unique_ptr<GlContext> context = make_offscreen_context();
    std::unique_ptr<LightProjection> way;
    if (by_queries)
        way = std::make_unique<OcclusionQueryProjection>(space, scene.quads, scene.occluders,
                                                         context->loader());
    else
        way = std::make_unique<ShadowProjection>(space, scene.quads, scene.occluders);
    PackedField field = PackedField::Zero(4, space.functions());
    double worst_rms = 0, worst_step = 0;
    for (auto _ : state) {
        std::vector<std::vector<double>> error(space.elements().size());
        for (int frame = 0; frame < frames; ++frame) {
            const int centimetres = frame < frames / 2 ? frame : frames - frame;
            way->project(scene.lamp(centimetres), field);
            const PackedField exact = direct_light(scene, centimetres);
            const double least = 1e-3 * flux_on_all(exact, space);
            for (std::size_t e = 0; e < error.size(); ++e) {
                const double right = flux(exact, space.element(e));
                error[e].push_back(right > least ? flux(field, space.element(e)) / right - 1 : 0);
            }
        }
        for (const std::vector<double>& of : error) {
            double squares = 0;
            for (std::size_t f = 2; f < of.size(); ++f) {
                squares += std::pow(of[f] - 2 * of[f - 1] + of[f - 2], 2);
                worst_step = std::max(worst_step, std::abs(of[f] - of[f - 1]));
            }
            worst_rms = std::max(worst_rms, std::sqrt(squares / frames));
        }
    }
    state.counters["second difference rms %"] = 100 * worst_rms;
    state.counters["largest step %"] = 100 * worst_step;
}

}  // namespace

void register_projection(const std::vector<std::string>& scenes) {
    const auto add = [](const char* what, const std::string& name, auto run) {
        return stage_benchmark(what, name,
                               [name, run](benchmark::State& state) { run(state, name); });
    };
    for (const std::string& name : scenes) {
        add("ShadowProjection", name, shadow_projection);
        add("OcclusionQueryProjection", name, occlusion_query_projection)->Arg(512)->Arg(1024);
        add("Agreement", name, agreement)->Iterations(1);
        add("FlickerOfRays", name, [](benchmark::State& state, const std::string& scene) {
            flicker(state, scene, false);
        })->Iterations(1);
        add("FlickerOfQueries", name, [](benchmark::State& state, const std::string& scene) {
            flicker(state, scene, true);
        })->Iterations(1);
        add("ExactProjection", name, exact_projection);
        add("RayPerCell", name, ray_per_cell);
    }
}

}  // namespace lightwell
