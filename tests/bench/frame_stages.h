#pragma once

#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "runtime/propagation/packed_field.h"
#include "tests/bench/bench_scenes.h"

namespace lightwell {

// The stages of a frame on their own, registered as benchmarks of every scene named.

void register_projection(const std::vector<std::string>& scenes);
void register_propagation(const std::vector<std::string>& scenes);

/// A benchmark called WHAT/SCENE, in milliseconds of wall time.
template <typename Run>
benchmark::internal::Benchmark* stage_benchmark(const std::string& what, const std::string& scene,
                                                const Run& run) {
    return benchmark::RegisterBenchmark((what + "/" + scene).c_str(), run)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
}

/// E of the scene's lamp, moved along x by so many centimetres, by the exact projector.
PackedField direct_light(const BenchScene& scene, int centimetres);

double median(std::vector<double> all);

}  // namespace lightwell
