#include "viewer/charts/operator_sweep.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "radiance4d/operator/light_projection.h"
#include "radiance4d/operator/operator_file.h"
#include "runtime/frame.h"
#include "runtime/projection/shadow_projection.h"
#include "solver/reference/deviation.h"

namespace lightwell {

namespace {

double seconds_of(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Medians over lamps, of a frame's stages [s].
struct FrameTimes {
    double projection = 0;
    double stored = 0;    ///< H E
    double gather = 0;    ///< T x, once
    double iterated = 0;  ///< T E + T^2 E + ... to a thousandth
    double synthesis = 0;
};

FrameTimes frame_times(const BuiltOperator& built, const ChartedScene& scene,
                       const std::vector<JudgedLight>& lights) {
    const GlobalTransport& transport = built.transport;
    Frame frame(transport,
                std::make_unique<ShadowProjection>(transport.space, scene.quads, scene.occluders));
    std::vector<double> projection, stored, gather, iterated, synthesis;
    frame.light({lights.front().light});  // gets memory
    for (const JudgedLight& one : lights) {
        const FrameReport& report = frame.light({one.light});
        projection.push_back(report.projection_seconds);
        stored.push_back(report.propagation_seconds);
        synthesis.push_back(report.synthesis_seconds);
        const RadianceField direct =
            projected_lights(transport.space, {one.light}, scene.quads, scene.occluders);
        RadianceField x = direct;
        gather.push_back(seconds_of(
            [&] { x = direct + propagated(transport.bounce, reflected(transport, direct)); }));
        iterated.push_back(seconds_of([&] {
            constexpr int most_steps = 200;
            for (int step = 0; step < most_steps; ++step) {
                const RadianceField next =
                    direct + propagated(transport.bounce, reflected(transport, x));
                const double change = (next - x).matrix().norm();
                x = next;
                if (change < 1e-3 * x.matrix().norm()) break;
            }
        }));
    }
    return {median(projection), median(stored), median(gather), median(iterated),
            median(synthesis)};
}

/// Bytes of the chunks of M (DTO) and of H (GTO), and of the whole file.
struct FileSizes {
    std::uint64_t dto = 0, gto = 0, all = 0;
};

FileSizes sizes_of(const GlobalTransport& transport, const std::string& scratch) {
    write_operator_file(scratch, transport);
    const OperatorFileInfo info = inspect_operator_file(scratch);
    std::filesystem::remove(scratch);
    FileSizes sizes;
    sizes.all = info.bytes;
    for (const ChunkSummary& chunk : info.chunks) {
        if (chunk.tag.rfind("DTO", 0) == 0) sizes.dto += chunk.stored;
        if (chunk.tag.rfind("GTO", 0) == 0) sizes.gto += chunk.stored;
    }
    return sizes;
}

std::uint64_t coefficients_of(const std::vector<TransportOperator>& operators) {
    std::uint64_t count = 0;
    for (const TransportOperator& one : operators)
        count += one.coefficients();
    return count;
}

}  // namespace

BuiltOperator built(const ChartedScene& scene, const PrecomputeOptions& options,
                    const Progress& progress) {
    PrecomputeOptions once = options;
    once.most_attempts = 0;
    PrecomputeReport report;
    BuiltOperator built;
    Progress silent;
    silent.stop_requested = progress.stop_requested;
    built.transport = precompute(scene.scene, once, silent, report);
    built.seconds = report.seconds["total"];
    built.series_seconds = report.seconds["series"];
    built.cells = static_cast<double>(report.cells);
    return built;
}

bool has_sum(const GlobalTransport& transport) {
    return std::all_of(transport.indirect.begin(), transport.indirect.end(),
                       [](const TransportOperator& one) {
                           return std::all_of(one.value.begin(), one.value.end(),
                                              [](float value) { return std::isfinite(value); });
                       });
}

std::vector<MeasuredSetting> measured(const std::string& method, const std::string& setting,
                                      const BuiltOperator& built, const ChartedScene& scene,
                                      const JudgedScene& judge, const std::string& scratch,
                                      Ways ways) {
    const GlobalTransport& transport = built.transport;
    const FileSizes sizes = sizes_of(transport, scratch);
    const FrameTimes times = frame_times(built, scene, judge.lights());
    const double around = times.projection + times.synthesis;
    const std::uint64_t dto = transport.bounce.coefficients();
    const std::uint64_t gto = coefficients_of(transport.indirect);
    MeasuredSetting one;
    one.setting = setting;
    one.rays = transport.provenance.rays;

    one.method = method + ": gathered";
    one.error = judge.error_of(transport, Propagation::gathered);
    one.precompute_seconds = built.seconds;
    one.coefficients = dto + gto;
    one.bytes = sizes.all;
    one.frame_milliseconds = 1000 * (around + times.stored + times.gather);
    std::vector<MeasuredSetting> settings{one};
    if (ways == Ways::gathered) return settings;

    one.method = method + ": G stored";
    one.error = judge.error_of(transport, Propagation::stored);
    one.coefficients = gto;
    one.bytes = sizes.all - sizes.dto;
    one.frame_milliseconds = 1000 * (around + times.stored);
    settings.push_back(one);
    if (ways == Ways::gathered_and_stored) return settings;

    one.method = method + ": T iterated";
    one.error = judge.error_of(transport, Propagation::solved);
    one.precompute_seconds = built.seconds - built.series_seconds;
    one.coefficients = dto;
    one.bytes = sizes.all - sizes.gto;
    one.frame_milliseconds = 1000 * (around + times.iterated);
    settings.push_back(one);
    return settings;
}

std::vector<MeasuredSetting> path_traced(const std::vector<double>& errors, double texels,
                                         const ChartedScene& scene, const JudgedScene& judge) {
    PathTracing few;
    few.samples = 32;
    few.batches = 8;
    std::vector<double> noises, seconds;
    for (const JudgedLight& one : judge.lights()) {
        const PathTracer tracer(scene.scene, scene.visibility, {one.light});
        LightSurvey survey;
        seconds.push_back(seconds_of([&] { survey = tracer.indirect(one.points, few); }) /
                          static_cast<double>(one.points.size()));
        const std::vector<Rgb> dark(one.points.size(), Rgb::Zero());
        const double noise = deviation_from(survey.at, dark, one.weight).noise;
        if (noise > 0) noises.push_back(noise);
    }
    std::vector<MeasuredSetting> settings;
    if (noises.empty()) return settings;
    for (const double error : errors) {
        const double paths = std::pow(median(noises) / error, 2);  // of few.samples each
        MeasuredSetting one;
        one.method = "path tracing in every frame";
        one.setting = fmt::format("{:.0f} paths a texel", std::max(1.0, paths * few.samples));
        one.error = {error, error, error};
        one.frame_milliseconds = 1000 * paths * texels * median(seconds);
        settings.push_back(one);
    }
    return settings;
}

}  // namespace lightwell
