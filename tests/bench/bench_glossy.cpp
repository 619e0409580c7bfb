// Where does the method end? Error and cost of a closed room with a glossy floor and a block on it
// against the Phong exponent of the floor, through the whole pipeline at one error asked for.
//
// The error is that of indirect radiance over the floor at three eye points against the path
// tracer, whose noise is taken off: gathered, as `measure --probes` and `render` show it, and read
// from the basis. The method ends where the finest directions leave more of the light that the
// floor reflects off than can be followed: from there on `precompute` warns.
#include <array>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "radiance4d/operator/smooth_irradiance.h"
#include "radiance4d/scene/brdf.h"
#include "solver/precompute.h"
#include "solver/radiance_bounce.h"
#include "tests/bench/counted_runs.h"
#include "tests/bench/glossy_room.h"
#include "tests/unit/reference/rooms.h"
#include "viewer/commands/lit_scene.h"
#include "viewer/commands/measure_command.h"

namespace lightwell {
namespace {

constexpr double error_asked = 0.05;

/// All emission is by one lamp.
Scene lit_room(const Lobe& lobe) {
    Scene scene = room_with_floor(lobe);
    scene.lights = {lamp_at({2.3, 1.0, 1.8})};
    return scene;
}

struct Errors {
    double gathered = 0, basis = 0;
};

Errors errors_of(const OpenedOperator& opened) {
    const Scene& scene = opened.transport.scene;
    const LitScene lit(opened, scene.lights);
    const FinalGather gather = lit.gather(gather_strata(error_asked));
    const std::vector<SmoothSurface> surfaces =
        smooth_irradiance(opened.transport.space, lit.lighting().indirect);
    const std::vector<RadianceProbe> probes = probes_of(opened.visibility);
    std::vector<Rgb> gathered(probes.size()), read(probes.size());
    tbb::parallel_for(std::size_t{0}, probes.size(), [&](std::size_t k) {
        const auto look = [&](const FinalGather* by) {
            return seen_light(opened, lit, scene.lights, surfaces, by, probes[k].position,
                              probes[k].direction)
                .indirect;
        };
        gathered[k] = look(&gather);
        read[k] = look(nullptr);
    });
    PathTracing how;
    how.samples = 2048;
    const LightSurvey survey =
        RadianceTracer(scene, opened.visibility, scene.lights).indirect(probes, how);
    return {deviation(gathered, survey), deviation(read, survey)};
}

/// What the room comes to, exponent by exponent.
struct Findings {
    Series gathered{"gathered", {}}, basis{"read from the basis", {}},
        lobe{"lobe itself in its directions", {}},
        finest{"light reflected, in the finest ones", {}}, followed{"what can be followed", {}};
    Series functions{"functions", {}}, links{"links", {}}, bounce{"coefficients of one bounce", {}},
        global{"coefficients of all bounces", {}}, milliseconds{"milliseconds", {}};
};

void run(benchmark::State& state, double exponent, Findings& findings) {
    const Scene scene = lit_room(PhongLobe{Rgb::Constant(0.7), exponent});
    PrecomputeOptions options;
    options.error = error_asked;
    options.most_attempts = 0;
    PrecomputeReport report;
    GlobalTransport transport;
    for (auto _ : state)
        transport = precompute(scene, options, {}, report);
    std::uint64_t global = 0;
    for (const TransportOperator& one : transport.indirect)
        global += one.coefficients();
    const std::uint64_t bounce = transport.bounce.coefficients();
    const std::uint64_t links = transport.provenance.links;
    const AngularNeed need = angular_needs(scene, lobes_of(scene.materials), error_asked).front();
    const Material& floor = scene.materials[floor_z0];
    const double specular = lobe_reflectance(floor.lobe).mean();
    const double finest = AngularReflection::at_level(floor.lobe, 5).error() * specular /
                          (specular + floor.reflectance.mean());
    const Errors errors = errors_of(opened(std::move(transport)));

    const auto note = [&](Series& series, const std::string& name, double value) {
        state.counters[name] = value;
        if (value > 0) series.points.emplace_back(exponent, value);
    };
    state.counters["level"] = need.level;
    state.counters["follows"] = need.follows ? 1 : 0;
    note(findings.lobe, "lobe_error_%", 100 * need.error);
    note(findings.finest, "finest_%", 100 * finest);
    note(findings.followed, "followed_%", 100 * followed_error(error_asked));
    note(findings.gathered, "gathered_%", 100 * errors.gathered);
    note(findings.basis, "basis_%", 100 * errors.basis);
    note(findings.functions, "functions", static_cast<double>(report.cells));
    note(findings.links, "links", static_cast<double>(links));
    note(findings.bounce, "T_coefficients", static_cast<double>(bounce));
    note(findings.global, "G_coefficients", static_cast<double>(global));
    note(findings.milliseconds, "ms", 1000 * report.seconds.at("total"));
}

/// How a count grows with the exponent between 5 and 50.
void print_growth(const Series& series) {
    std::vector<std::pair<double, double>> between;
    for (const auto& point : series.points)
        if (point.first >= 5 && point.first <= 50) between.push_back(point);
    if (between.size() >= 2)
        std::cout << fmt::format("  {:<28} n^{:.2f}\n", series.name,
                                 fitted_power(between).exponent);
}

}  // namespace
}  // namespace lightwell

int main(int argc, char** argv) {
    using namespace lightwell;
    Findings findings;
    for (const int exponent : {1, 2, 5, 10, 20, 30, 50, 100, 200})
        benchmark::RegisterBenchmark(
            fmt::format("phong/{}", exponent).c_str(),
            [exponent, &findings](benchmark::State& state) { run(state, exponent, findings); })
            ->Iterations(1)
            ->Unit(benchmark::kSecond)
            ->UseRealTime();
    return run_and_count(argc, argv, [&findings] {
        std::cout << "\ngrowth over exponents 5 to 50, by least squares of the logarithms:\n";
        for (const Series* series :
             {&findings.functions, &findings.links, &findings.bounce, &findings.global})
            print_growth(*series);
        write_chart("glossy-error", {"Glossy floor at 5 %: error against the Phong exponent",
                                     "Phong exponent",
                                     "relative error [%]",
                                     {findings.gathered, findings.basis, findings.lobe,
                                      findings.finest, findings.followed}});
        write_chart("glossy-cost", {"Glossy floor at 5 %: cost against the Phong exponent",
                                    "Phong exponent",
                                    "count, and milliseconds",
                                    {findings.functions, findings.links, findings.bounce,
                                     findings.global, findings.milliseconds}});
    });
}
