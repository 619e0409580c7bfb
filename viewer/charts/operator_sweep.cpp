#include "viewer/charts/operator_sweep.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
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

/// A frame's stages [s].
struct FrameTimes {
    double projection = 0;
    double stored = 0;    ///< H E
    double gather = 0;    ///< T x, once
    double iterated = 0;  ///< T E + T^2 E + ... until a step changes less than a tenth of the error
    double synthesis = 0;
};

/// Each stage apart: the shorter time, since what others do on the machine only adds to it.
FrameTimes shorter(const FrameTimes& a, const FrameTimes& b) {
    return {std::min(a.projection, b.projection), std::min(a.stored, b.stored),
            std::min(a.gather, b.gather), std::min(a.iterated, b.iterated),
            std::min(a.synthesis, b.synthesis)};
}

/// Each stage apart: the median over lamps.
FrameTimes median_of(const std::vector<FrameTimes>& lamps) {
    const auto of = [&](double FrameTimes::*stage) {
        std::vector<double> values;
        for (const FrameTimes& one : lamps)
            values.push_back(one.*stage);
        return median(values);
    };
    return {of(&FrameTimes::projection), of(&FrameTimes::stored), of(&FrameTimes::gather),
            of(&FrameTimes::iterated), of(&FrameTimes::synthesis)};
}

/// E + T x.
RadianceField once_more(const GlobalTransport& transport, const RadianceField& direct,
                        const RadianceField& x) {
    return direct + propagated(transport.bounce, reflected(transport, x));
}

void iterate(const GlobalTransport& transport, const RadianceField& direct, double tolerance) {
    constexpr int most_steps = 200;
    RadianceField x = once_more(transport, direct, direct);
    for (int step = 0; step < most_steps; ++step) {
        const RadianceField next = once_more(transport, direct, x);
        const double change = (next - x).matrix().norm();
        x = next;
        if (change < tolerance * x.matrix().norm()) break;
    }
}

/// Lights up one lamp after the other, round after round: a frame with the lamp of the frame before
/// would be no work.
FrameTimes frame_times(const BuiltOperator& built, const ChartedScene& scene,
                       const std::vector<JudgedLight>& lights, double error) {
    constexpr std::size_t most_lamps = 8;
    constexpr int rounds = 3;
    const GlobalTransport& transport = built.transport;
    Frame frame(transport,
                std::make_unique<ShadowProjection>(transport.space, scene.quads, scene.occluders));
    frame.light({lights.back().light});  // gets memory
    std::vector<FrameTimes> shortest(std::min(lights.size(), most_lamps));
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t k = 0; k < shortest.size(); ++k) {
            const std::vector<Light> lamp{lights[k].light};
            const FrameReport report = frame.light(lamp);
            const RadianceField direct =
                projected_lights(transport.space, lamp, scene.quads, scene.occluders);
            const FrameTimes now = {report.projection_seconds, report.propagation_seconds,
                                    seconds_of([&] { once_more(transport, direct, direct); }),
                                    seconds_of([&] { iterate(transport, direct, 0.1 * error); }),
                                    report.synthesis_seconds};
            shortest[k] = round == 0 ? now : shorter(shortest[k], now);
        }
    }
    return median_of(shortest);
}

/// Bytes of the chunks of M (DTO) and of H (GTO), and of the whole file.
struct FileSizes {
    std::uint64_t dto = 0, gto = 0, all = 0;
};

FileSizes sizes_of(const GlobalTransport& transport) {
    const std::vector<ChunkSummary> chunks = operator_file_chunks(transport);
    FileSizes sizes;
    sizes.all = chunks.back().offset + chunks.back().stored;
    for (const ChunkSummary& chunk : chunks) {
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
    constexpr double long_enough = 2;  // [s]
    constexpr int most_runs = 3;
    Progress silent;
    silent.stop_requested = progress.stop_requested;
    BuiltOperator built;
    built.seconds = std::numeric_limits<double>::infinity();
    double spent = 0;
    for (int run = 0; run < most_runs && spent < long_enough; ++run) {
        PrecomputeReport report;
        GlobalTransport transport = precompute(scene.scene, options, silent, report);
        const double seconds = report.seconds["total"];
        spent += seconds;
        if (seconds >= built.seconds) continue;
        built = {std::move(transport), seconds, report.seconds["series"], 0,
                 static_cast<std::uint64_t>(report.estimate_rays)};
    }
    for (const Element& element : built.transport.space.elements())
        built.cells += element.space.tree().functions();
    return built;
}

BuiltOperator built_once(const ChartedScene& scene, PrecomputeOptions options,
                         const Progress& progress) {
    options.most_attempts = 0;
    return built(scene, options, progress);
}

std::vector<MeasuredSetting> measured(const Method& method, const std::string& setting,
                                      const BuiltOperator& built, const ChartedScene& scene,
                                      const JudgedScene& judge) {
    const GlobalTransport& transport = built.transport;
    const FileSizes sizes = sizes_of(transport);
    const FrameTimes times =
        frame_times(built, scene, judge.lights(), transport.provenance.error_asked);
    const double around = times.projection + times.synthesis;
    const std::uint64_t dto = transport.bounce.coefficients();
    const std::uint64_t gto = coefficients_of(transport.indirect);
    MeasuredSetting one;
    one.setting = setting;
    one.cells = built.cells;
    one.rays = transport.provenance.rays;
    one.is_one_of_a_line = method.is_one_of_a_line;
    std::vector<MeasuredSetting> settings;
    const auto add = [&](const std::string& way, Propagation propagation) {
        const JudgedError judged = judge.error_of(transport, propagation);
        one.method = method.name + ": " + way;
        one.look = {method.colour, static_cast<int>(settings.size())};
        one.error = judged.rms;
        one.worst_lamp = judged.worst_lamp;
        settings.push_back(one);
    };

    one.precompute_seconds = built.seconds;
    one.coefficients = dto + gto;
    one.bytes = sizes.all;
    one.frame_milliseconds = 1000 * (around + times.stored + times.gather);
    add("gathered", Propagation::gathered);
    if (method.ways == Ways::gathered) return settings;

    one.coefficients = gto;
    one.bytes = sizes.all - sizes.dto;
    one.frame_milliseconds = 1000 * (around + times.stored);
    add("G stored", Propagation::stored);
    if (method.ways == Ways::gathered_and_stored) return settings;

    one.precompute_seconds = built.seconds - built.series_seconds;
    one.coefficients = dto;
    one.bytes = sizes.all - sizes.gto;
    one.frame_milliseconds = 1000 * (around + times.iterated);
    add("T iterated", Propagation::solved);
    return settings;
}

std::vector<MeasuredSetting> path_traced(const std::vector<MeasuredSetting>& others, int colour,
                                         const ChartedScene& scene, const JudgedScene& judge) {
    PathTracing few;
    few.samples = 32;
    few.batches = 8;
    std::vector<double> noises, seconds;
    for (const JudgedLight& one : judge.lights()) {
        const PathTracer tracer(scene.scene, scene.visibility, {one.light});
        LightSurvey survey;
        seconds.push_back(seconds_of([&] { survey = tracer.indirect(one.points, few); }) /
                          static_cast<double>(one.points.size()) / few.samples);
        const std::vector<Rgb> dark(one.points.size(), Rgb::Zero());
        const double noise = deviation_from(survey.at, dark, one.weight).noise;
        if (noise > 0) noises.push_back(noise * std::sqrt(few.samples));
    }
    std::vector<MeasuredSetting> settings;
    if (noises.empty()) return settings;
    const double noise = median(noises), seconds_a_path = median(seconds);
    for (const MeasuredSetting& other : others) {
        if (!(other.error.value > 0)) continue;
        const double paths = std::ceil(std::pow(noise / other.error.value, 2));
        const double error = noise / std::sqrt(paths);
        MeasuredSetting one;
        one.method = "path tracing in every frame";
        one.setting = fmt::format("{:.0f} paths a texel", paths);
        one.error = {error, error, error};
        one.cells = other.cells;
        one.frame_milliseconds = 1000 * paths * static_cast<double>(other.cells) * seconds_a_path;
        one.look = {colour, 0};
        settings.push_back(one);
    }
    return settings;
}

}  // namespace lightwell
