// What the product H E costs, alone and as updates while a lamp moves.
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "radiance4d/operator/light_projection.h"
#include "runtime/projection/fastest_projection.h"
#include "runtime/propagation/fitting_format.h"
#include "runtime/propagation/incremental_update.h"
#include "tests/bench/frame_stages.h"

namespace lightwell {

namespace {

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

}  // namespace

void register_propagation(const std::vector<std::string>& scenes) {
    for (const std::string& name : scenes) {
        stage_benchmark("PlainProduct", name,
                        [name](benchmark::State& state) { plain_product(state, name); });
        const std::pair<const char*, ValueFormat> formats[] = {
            {"PropagationSingle", ValueFormat::single},
            {"PropagationHalf", ValueFormat::half},
            {"PropagationByte", ValueFormat::byte}};
        for (const auto& [title, format] : formats)
            stage_benchmark(title, name, [name, value = format](benchmark::State& state) {
                propagation(state, name, value);
            });
        const std::pair<const char*, UpdateMode> modes[] = {
            {"UpdateFresh", UpdateMode::fresh},
            {"UpdateIncremental", UpdateMode::incremental},
            {"UpdatePerBand", UpdateMode::per_band}};
        for (const auto& [title, mode] : modes)
            stage_benchmark(
                title, name,
                [name, value = mode](benchmark::State& state) { update(state, name, value); })
                ->Arg(30)
                ->Arg(300)
                ->Arg(0);
    }
}

}  // namespace lightwell
