#include "tests/bench/counted_runs.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "radiance4d/atomic_file.h"

namespace lightwell {

namespace {

/// 12345678 as 12,345,678; anything else with four digits.
std::string readable(double value) {
    if (value < 1000 || value != std::floor(value)) return fmt::format("{:.4g}", value);
    std::string text = fmt::format("{:.0f}", value);
    for (std::size_t end = text.size(); end > 3;) {
        end -= 3;
        text.insert(end, ",");
    }
    return text;
}

/// With its arguments, but without how it was timed.
std::string name_of(const benchmark::BenchmarkReporter::Run& run) {
    benchmark::BenchmarkName name = run.run_name;
    name.iterations.clear();
    name.time_type.clear();
    return name.str();
}

class CountsFirst : public benchmark::BenchmarkReporter {
  public:
    bool ReportContext(const Context&) override { return true; }

    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            any_ = true;
            if (run.error_occurred)
                std::cout << fmt::format("{:<34} {}\n", name_of(run), run.error_message);
            else
                print(run);
            std::cout << std::flush;
        }
    }

    bool any() const { return any_; }

  private:
    void print(const Run& run) {
        std::vector<std::string> names;
        for (const auto& [name, counter] : run.counters)
            names.push_back(name);
        if (names != names_) {
            names_ = names;
            std::string head = fmt::format("{:<34}", "");
            for (const std::string& name : names)
                head += fmt::format(" {:>{}}", name, width_of(name));
            std::cout << head << fmt::format(" {:>12}\n", "time");
        }
        std::string row = fmt::format("{:<34}", name_of(run));
        for (const auto& [name, counter] : run.counters)
            row += fmt::format(" {:>{}}", readable(counter.value), width_of(name));
        std::cout << row
                  << fmt::format(" {:>9.4g} {}\n", run.GetAdjustedRealTime(),
                                 benchmark::GetTimeUnitString(run.time_unit));
    }

    static std::size_t width_of(const std::string& name) {
        return std::max<std::size_t>(name.size(), 11);
    }

    std::vector<std::string> names_;
    bool any_ = false;
};

}  // namespace

int run_and_count(int argc, char** argv, const std::function<void()>& afterwards) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    CountsFirst reporter;
    try {
        benchmark::RunSpecifiedBenchmarks(&reporter);
        if (afterwards && reporter.any()) afterwards();
        return 0;
    } catch (const std::exception& failure) {
        std::cerr << argv[0] << ": " << failure.what() << '\n';
        return 1;
    }
}

void write_chart(const std::string& name, const Chart& chart) {
    const std::string path = std::string(LIGHTWELL_CHARTS) + "/" + name;
    write_atomically(path + ".svg", svg_of(chart));
    write_atomically(path + ".csv", csv_of(chart));
    std::cout << fmt::format("charted in {0}.svg and {0}.csv\n", path);
}

}  // namespace lightwell
