// How fast .gto files are read and written, against reading their bytes alone (as cat does).

#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "radiance4d/operator/operator_file.h"
#include "tests/bench/counted_runs.h"

namespace lightwell {

namespace {

/// A random operator with dense runs and gaps between them, as refined links leave, and values over
/// many magnitudes.
TransportOperator operator_like(std::uint32_t size, std::uint32_t per_column, bool upper_half,
                                std::uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> magnitude(-6.0F, 2.0F);
    TransportOperator result;
    result.size = size;
    result.column_start.push_back(0);
    for (std::uint32_t column = 0; column < size; ++column) {
        const std::uint32_t rows = upper_half ? column + 1 : size;
        for (std::uint64_t row = random() % 64, k = 0; row < rows && k < per_column; ++k) {
            result.row.push_back(static_cast<std::uint32_t>(row));
            const float value = std::exp(magnitude(random));
            result.value.push_back(random() % 2 == 0 ? value : -value);
            row += random() % 4 == 0 ? 1 + random() % (2 * size / per_column) : 1;
        }
        result.column_start.push_back(result.row.size());
    }
    return result;
}

/// About 20 million coefficients over 65,536 functions: half in the bounce, half in H.
const GlobalTransport& large_transport() {
    static const GlobalTransport transport = [] {
        GlobalTransport made;
        made.scene.materials.emplace_back();
        const Quad wall{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}};
        made.scene.quads.push_back({wall, 0, 0, 0});
        Element element;
        element.geometry = wall;
        element.space = HaarBasis(wall, CellTree(std::vector<Split>(8, Split::both)));
        made.space = RadianceSpace({element});
        const std::uint32_t size = made.space.functions();
        made.bounce.upper = operator_like(size, 155, true, 1);
        made.indirect = {operator_like(size, 155, false, 2)};
        return made;
    }();
    return transport;
}

std::uint64_t coefficients() {
    return large_transport().bounce.coefficients() + large_transport().indirect[0].coefficients();
}

/// The large transport in a file, gone at the end.
class LargeFile {
  public:
    LargeFile() { write_operator_file(path, large_transport()); }
    ~LargeFile() { std::remove(path.c_str()); }
    LargeFile(const LargeFile&) = delete;
    LargeFile& operator=(const LargeFile&) = delete;

    const std::string path = "bench_operator_file_" + std::to_string(getpid()) + ".gto";
};

void count(benchmark::State& state, const std::string& path) {
    const double bytes = static_cast<double>(inspect_operator_file(path).bytes);
    const auto runs = static_cast<double>(state.iterations());
    state.SetBytesProcessed(static_cast<std::int64_t>(bytes * runs));
    state.counters["file_MB"] = bytes / 1e6;
    state.counters["bytes_per_coefficient"] = bytes / static_cast<double>(coefficients());
    state.counters["coefficients_per_second"] =
        benchmark::Counter(static_cast<double>(coefficients()) * runs, benchmark::Counter::kIsRate);
}

void bytes_alone(benchmark::State& state) {
    const LargeFile file;
    std::vector<char> block(std::size_t{1} << 17);
    for (auto _ : state) {
        std::FILE* stream = std::fopen(file.path.c_str(), "rb");
        std::setvbuf(stream, nullptr, _IONBF, 0);
        while (std::fread(block.data(), 1, block.size(), stream) > 0)
            benchmark::ClobberMemory();
        std::fclose(stream);
    }
    count(state, file.path);
}

void read_operator(benchmark::State& state) {
    const LargeFile file;
    for (auto _ : state)
        benchmark::DoNotOptimize(read_operator_file(file.path).bounce.coefficients());
    count(state, file.path);
}

void write_operator(benchmark::State& state) {
    const LargeFile file;
    for (auto _ : state)
        write_operator_file(file.path, large_transport());
    count(state, file.path);
}

BENCHMARK(bytes_alone)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(read_operator)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(write_operator)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

}  // namespace lightwell

int main(int argc, char** argv) {
    return lightwell::run_and_count(argc, argv);
}
