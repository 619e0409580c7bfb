// What the default oracle and the paper's oracle cost for the error that they reach: the same
// scene, the same cells, the same truncation, and one tolerance after another.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "radiance4d/scene/occluder_tree.h"
#include "radiance4d/scene/scene_quads.h"
#include "solver/precompute.h"
#include "solver/reading/scene_reader.h"
#include "solver/reference/error_estimate.h"
#include "solver/reference/random_lights.h"
#include "tests/bench/counted_runs.h"

namespace lightwell {
namespace {

/// What one oracle reached at one tolerance.
struct Reached {
    double error = 0;      ///< relative rms of the picture's indirect light over unseen lights
    double link_rays = 0;  ///< traced to judge links
    double all_rays = 0;   ///< with those that look round from cells, which both oracles need
};

/// One scene and what path tracing makes of it for lights that no operator was made for.
class Comparison {
  public:
    Comparison()
        : scene_(dark_scene()), quads_(quads_of(scene_)), visibility_(quads_), occluders_(quads_) {}

    void run(benchmark::State& state, OracleKind oracle, double tolerance) {
        PrecomputeOptions options;
        options.oracle = oracle;
        options.oracle_tolerance = tolerance;
        options.cell_size = cell_size;
        options.truncation = truncation;
        options.most_attempts = 0;
        PrecomputeReport report;
        GlobalTransport transport;
        for (auto _ : state)
            transport = precompute(scene_, options, {}, report);
        judge(transport);
        Reached reached;
        reached.error = estimate_error(transport, quads_, occluders_, judged_, {}).rms();
        reached.link_rays = static_cast<double>(report.link_rays);
        reached.all_rays = static_cast<double>(transport.provenance.rays);
        (oracle == OracleKind::geometric ? geometric_ : variation_).push_back(reached);
        state.counters["error"] = reached.error;
        state.counters["link_rays"] = reached.link_rays;
        state.counters["all_rays"] = reached.all_rays;
        state.counters["links"] = static_cast<double>(transport.provenance.links);
        state.counters["coefficients"] = static_cast<double>(transport.indirect[0].coefficients());
    }

    void print_ratios() const {
        if (variation_.empty()) return;
        std::cout << "\nrays of the paper's oracle over those of the default, at the error that "
                     "the default reached:\n";
        for (const Reached& reached : geometric_) {
            const auto links = interpolated(reached.error, &Reached::link_rays);
            const auto all = interpolated(reached.error, &Reached::all_rays);
            if (!links || !all) {
                const Reached& best = best_of(variation_);
                if (reached.error < best.error)
                    std::cout << fmt::format(
                        "  error {:.4f}: more than {:.0f} times the rays for links: {:.3g} reach "
                        "{:.4f} only\n",
                        reached.error, best.link_rays / reached.link_rays, best.link_rays,
                        best.error);
                continue;
            }
            std::cout << fmt::format(
                "  error {:.4f}: {:5.1f} times the rays for links ({:.3g} against {:.3g}), {:5.1f} "
                "times all rays ({:.3g} against {:.3g})\n",
                reached.error, *links / reached.link_rays, *links, reached.link_rays,
                *all / reached.all_rays, *all, reached.all_rays);
        }
    }

    Chart chart() const {
        return {"Cornell box: rays for the error reached",
                "relative rms error",
                "rays",
                {series("paper: links", variation_, &Reached::link_rays),
                 series("default: links", geometric_, &Reached::link_rays),
                 series("paper: all", variation_, &Reached::all_rays),
                 series("default: all", geometric_, &Reached::all_rays)}};
    }

  private:
    static constexpr double cell_size = 0.245;   ///< [m]: 6,080 cells
    static constexpr double truncation = 0.015;  ///< small beside the oracle's error

    static const Reached& best_of(const std::vector<Reached>& all) {
        return *std::min_element(all.begin(), all.end(), [](const Reached& a, const Reached& b) {
            return a.error < b.error;
        });
    }

    static Scene dark_scene() {
        Scene scene = read_scene(std::string(LIGHTWELL_SCENES) + "/cornell-box/scene.toml").scene;
        for (Material& material : scene.materials)
            material.emission.setZero();
        return scene;
    }

    void judge(const GlobalTransport& transport) {
        constexpr int lights = 10;
        constexpr std::uint64_t seed = 2718;
        if (!judged_.empty()) return;
        std::vector<Vec3> positions;
        for (const PointLight& light : random_lights(scene_, visibility_, lights, seed))
            positions.push_back(light.position);
        EstimateOptions options;
        options.noise = 0.02;
        options.seed = seed;
        judged_ = judged_lights(transport, quads_, visibility_, occluders_, positions, options, {});
    }

    /// What the paper's oracle would need for an error between two that it reached; nothing
    /// outside.
    std::optional<double> interpolated(double error, double Reached::*cost) const {
        for (std::size_t k = 1; k < variation_.size(); ++k) {
            const Reached &a = variation_[k - 1], &b = variation_[k];
            if ((a.error - error) * (b.error - error) > 0 || a.error == b.error) continue;
            const double share = std::log(error / a.error) / std::log(b.error / a.error);
            return a.*cost * std::pow(b.*cost / (a.*cost), share);
        }
        return std::nullopt;
    }

    static Series series(const std::string& name, const std::vector<Reached>& all,
                         double Reached::*cost) {
        Series series{name, {}};
        for (const Reached& reached : all)
            series.points.emplace_back(reached.error, reached.*cost);
        return series;
    }

    Scene scene_;
    std::vector<Quad> quads_;
    Visibility visibility_;
    OccluderTree occluders_;
    std::vector<JudgedLight> judged_;
    std::vector<Reached> geometric_, variation_;
};

void add(Comparison& comparison, const std::string& name, OracleKind oracle, double tolerance) {
    benchmark::RegisterBenchmark(fmt::format("{}/{:g}", name, tolerance).c_str(),
                                 [&comparison, oracle, tolerance](benchmark::State& state) {
                                     comparison.run(state, oracle, tolerance);
                                 })
        ->Iterations(1)
        ->Unit(benchmark::kSecond)
        ->UseRealTime();
}

}  // namespace
}  // namespace lightwell

int main(int argc, char** argv) {
    using namespace lightwell;
    Comparison comparison;
    for (const double tolerance : {1e-3, 3e-4, 1e-4, 4e-5})
        add(comparison, "default", OracleKind::geometric, tolerance);
    for (const double tolerance : {0.1, 0.03, 0.01, 0.0025})
        add(comparison, "paper", OracleKind::variation, tolerance);
    return run_and_count(argc, argv, [&comparison] {
        comparison.print_ratios();
        write_chart("oracles", comparison.chart());
    });
}
