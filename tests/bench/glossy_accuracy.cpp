// How far does radiance by direction follow a lobe, and at what cost?
//
//     glossy_accuracy [--cell METRES] [--tolerance T] [--directions T] [--samples N] [EXPONENT ...]
//
// prints one CSV row per Phong exponent, for a closed room with a glossy floor and a block on it,
// lit by one lamp: what the representation needs (angular level, its error, whether that is within
// the tolerance), what the operator costs (basis functions, directed links, rays, coefficients,
// seconds), and the relative L2 error of indirect radiance over the floor at three eye points, in
// blocks of the basis and unsmoothed, against the path tracer, whose noise is taken off.
#include <chrono>
#include <cmath>
#include <iostream>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "radiance4d/operator/light_projection.h"
#include "radiance4d/operator/reflection.h"
#include "runtime/outgoing/brdf_product.h"
#include "solver/radiance_bounce.h"
#include "tests/bench/glossy_room.h"
#include "tests/unit/reference/rooms.h"

namespace lightwell {
namespace {

/// Relative root mean square error of luminance, with the judge's noise taken off.
double deviation(const std::vector<double>& seen, const LightSurvey& survey) {
    double off = 0, squares = 0;
    for (std::size_t k = 0; k < seen.size(); ++k) {
        const double exact = luminance(survey.at[k].mean);
        off += std::pow(seen[k] - exact, 2) - std::pow(luminance(survey.at[k].standard_error), 2);
        squares += exact * exact;
    }
    return std::sqrt(std::max(0.0, off) / squares);
}

/// Seconds since a moment, which becomes now.
double lap(std::chrono::steady_clock::time_point& last) {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last).count();
    last = now;
    return seconds;
}

void print_row(double exponent, const RadianceBounceOptions& options, int samples) {
    const Scene scene = room_with_floor(PhongLobe{Rgb::Constant(0.7), exponent});
    const PointLight lamp = lamp_at({2.3, 1.0, 1.8});
    OracleCost cost;
    const Ground ground(scene, cost);
    const AngularReflection lobe(PhongLobe{Rgb::Constant(0.7), exponent}, options.angle);

    auto last = std::chrono::steady_clock::now();
    const RadianceBounce bounce = radiance_bounce(ground, options);
    const double seconds_bounce = lap(last);
    const Reflection reflection(scene, bounce.space);
    const double seconds_reflection = lap(last);
    const RadianceField bounced =
        bounced_light(bounce.propagation, reflection,
                      projected_lights(bounce.space, {lamp}, ground.quads, ground.occluders));
    const double seconds_solve = lap(last);

    const BrdfProduct product(scene, bounce.space, bounced);
    const auto floor = static_cast<std::size_t>(bounce.space.element_on(floor_z0, true));
    const std::vector<RadianceProbe> probes = probes_of(ground.visibility);
    std::vector<double> seen;
    for (const RadianceProbe& probe : probes) {
        const Hit hit = ground.visibility.nearest(probe.position, free_point, probe.direction);
        const Vec3 at = probe.position + hit.distance * probe.direction;
        seen.push_back(luminance(product.radiance(
            floor, bounce.space.element(floor).geometry.parameters(at), -probe.direction)));
    }
    PathTracing how;
    how.samples = samples;
    const LightSurvey survey =
        RadianceTracer(scene, ground.visibility, {lamp}).indirect(probes, how);
    fmt::print("{},{},{:.3f},{},{},{},{},{},{:.2f},{:.2f},{:.2f},{:.4f}\n", exponent, lobe.level(),
               lobe.error(), lobe.follows() ? 1 : 0, bounce.space.functions(),
               bounce.directed_links, bounce.rays, bounce.propagation.coefficients(),
               seconds_bounce, seconds_reflection, seconds_solve, deviation(seen, survey));
    std::cout.flush();
}

}  // namespace
}  // namespace lightwell

int main(int argc, char** argv) {
    using namespace lightwell;
    CLI::App app{"Accuracy and cost of glossy transport over Phong exponents"};
    std::vector<double> exponents = {1, 5, 10, 20, 30, 50, 100, 200};
    RadianceBounceOptions options;
    int samples = 1024;
    app.add_option("exponents", exponents);
    app.add_option("--cell", options.cell_size, "largest side of a finest spatial cell [m]");
    app.add_option("--tolerance", options.angle.tolerance, "of the angular representation");
    app.add_option("--directions", options.directions.tolerance,
                   "of links for directions that they do not tell apart");
    app.add_option("--samples", samples, "paths a probe");
    CLI11_PARSE(app, argc, argv);
    std::cout << "exponent,level,angular_error,follows,functions,directed_links,rays,coefficients,"
                 "seconds_bounce,seconds_reflection,seconds_solve,error\n";
    for (const double exponent : exponents)
        print_row(exponent, options, samples);
}
