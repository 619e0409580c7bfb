#include "solver/glossy_operator.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <tbb/parallel_for.h>

#include "radiance4d/basis/angular_reflection.h"
#include "radiance4d/scene/brdf.h"
#include "solver/diffuse_operator.h"
#include "solver/radiance_bounce.h"
#include "solver/series/directed_series.h"
#include "solver/series/light_ensemble.h"

namespace lightwell {

namespace {

/// Lights that are expected and held side by side.
constexpr std::size_t lights_at_once = 48;

/// Direct light of white unit lamps.
std::vector<DirectedLights> projected(const RadianceSpace& space, const Ground& ground,
                                      const std::vector<Vec3>& positions,
                                      const Progress& progress) {
    constexpr std::size_t lanes = Reflection::Fields::ColsAtCompileTime;
    std::vector<DirectedLights> lights((positions.size() + lanes - 1) / lanes);
    tbb::parallel_for(std::size_t{0}, lights.size(), [&](std::size_t block) {
        std::vector<Eigen::ArrayXd> fields;
        for (std::size_t k = block * lanes; k < std::min((block + 1) * lanes, positions.size());
             ++k) {
            progress.check();
            fields.push_back(white_light(space, positions[k], ground.quads, ground.occluders));
        }
        lights[block] = DirectedLights::of(fields);
    });
    return lights;
}

/// How much functions carry for lights in all rooms, in groups of about one size. As many as
/// diffuse scenes have leave out nothing more in scenes/glossy and 15 % in scenes/gallery, where
/// they take a sixth of the time: each is propagated.
DirectedWeights expected_weights(const SymmetricOperator& propagation, const RadianceSpace& space,
                                 const Reflection& reflection, const Ground& ground,
                                 const Progress& progress) {
    const std::size_t lights = ground.in_rooms.size();
    const std::size_t groups = (lights + lights_at_once - 1) / lights_at_once;
    DirectedEnsemble ensemble(propagation, space, reflection);
    for (std::size_t g = 0; g < groups; ++g) {
        const auto place = [&](std::size_t group) {
            return ground.in_rooms.begin() + static_cast<std::ptrdiff_t>(group * lights / groups);
        };
        ensemble.add(projected(space, ground, {place(g), place(g + 1)}, progress), progress);
    }
    return ensemble.weights();
}

/// Of coefficients as they stand.
double hilbert_schmidt_norm(const std::vector<Coefficient>& coefficients) {
    double squares = 0;
    for (const Coefficient& c : coefficients)
        squares += static_cast<double>(c.value) * static_cast<double>(c.value);
    return std::sqrt(squares);
}

/// 1 where a twentieth of the surfaces or more is glossy, less in proportion where less is: a sign
/// of 0.5 m2 in an office, taken for a glossy scene, took three attempts instead of one.
double glossiness(const Ground& ground) {
    constexpr double enough = 0.05;
    double glossy = 0, all = 0;
    for (const Element& element : ground.elements) {
        all += element.area();
        if (is_glossy(ground.scene.material_of(element.quad))) glossy += element.area();
    }
    return std::min(1.0, glossy / (enough * all));
}

AngularResolution angle_at(const PrecomputeOptions& options, const Settings& settings) {
    AngularResolution angle = angular_resolution(options.error);
    angle.tolerance = settings.angular_tolerance;
    return angle;
}

/// The largest error of a lobe (see AngularReflection) among those that could have finer
/// directions; 0 where none could.
double coarsest_lobe(const Ground& ground, const AngularResolution& angle) {
    std::set<std::size_t> glossy;
    for (const Element& element : ground.elements)
        if (is_glossy(ground.scene.material_of(element.quad)))
            glossy.insert(ground.scene.material_number(element.quad));
    double coarsest = 0;
    for (const std::size_t material : glossy) {
        const AngularReflection lobe(ground.lobes[material], angle);
        if (lobe.level() < angle.most_levels) coarsest = std::max(coarsest, lobe.error());
    }
    return coarsest;
}

/// Factor of settings after an operator came out `missed` times as wrong as asked.
double shrunk_by(double missed) {
    return std::clamp(0.9 / missed, 0.5, 0.9);
}

void tighten_links(const PrecomputeOptions& options, double missed, Settings& settings) {
    const double factor = shrunk_by(missed);
    if (!options.oracle_tolerance) settings.oracle_tolerance *= factor * factor;
    if (!options.truncation) settings.truncation *= factor;
}

RadianceBounceOptions bounce_options(const Ground& ground, const PrecomputeOptions& options,
                                     const Settings& settings) {
    RadianceBounceOptions result;
    result.cell_size = settings.cell_size;
    if (!options.cell_size) result.finer_gloss = glossy_looseness(ground);
    result.oracle.partial_tolerance =
        result.oracle.partial_tolerance / result.oracle.tolerance * settings.oracle_tolerance;
    result.oracle.tolerance = settings.oracle_tolerance;
    result.directions.tolerance *= settings.oracle_tolerance / GeometricOracleOptions().tolerance;
    result.angle = angle_at(options, settings);
    return result;
}

}  // namespace

double glossy_looseness(const Ground& ground) {
    return 1 + glossiness(ground);
}

Settings glossy_settings(const PrecomputeOptions& options, const Ground& ground) {
    Settings settings = settings_for(options, ground.distance, ground.elements.size());
    const double looseness = glossy_looseness(ground);
    if (!options.cell_size) settings.cell_size *= looseness;
    if (!options.truncation) settings.truncation *= looseness;
    settings.angular_tolerance = angular_resolution(options.error).tolerance;
    return settings;
}

void tighten_glossy_cells(const Ground& /*ground*/, const PrecomputeOptions& options, double missed,
                          Settings& settings) {
    // Cells are halved: with hardly smaller ones next to none would change.
    constexpr double change_at_least = 0.7;
    tighten_links(options, missed, settings);
    if (!options.cell_size) settings.cell_size *= std::min(shrunk_by(missed), change_at_least);
}

void tighten_glossy(const Ground& ground, const PrecomputeOptions& options, double missed,
                    Settings& settings) {
    // One level more (errors of lobes fall by 0.45 to 0.8 from one level to the next) makes four
    // times as many functions, which are 1.3 times as good in scenes/glossy, as are finer cells.
    // Lobes about as coarse as the coarsest get it together.
    constexpr double one_is_enough = 1.4, as_coarse = 0.8;
    const double coarsest = coarsest_lobe(ground, angle_at(options, settings));
    if (coarsest > 0) settings.angular_tolerance = as_coarse * coarsest;
    if (coarsest == 0 || missed > one_is_enough)
        tighten_glossy_cells(ground, options, missed, settings);
    else
        tighten_links(options, missed, settings);
}

double glossy_functions(const Ground& ground, const PrecomputeOptions& options,
                        const Settings& settings) {
    return directed_functions(ground, bounce_options(ground, options, settings));
}

double glossy_memory_for(const Ground& ground, double functions, double truncation) {
    // Measured are 2.3 to 5.3 kB a function among ten elements, and 7 to 14 kB among 2888: every
    // function has coefficients with each of those that it sees.
    constexpr double bytes_apart = 5700, bytes_an_element = 3, bytes_a_pair = 120;
    const double bytes_a_function =
        bytes_apart + bytes_an_element * static_cast<double>(ground.elements.size());
    return bytes_a_function * functions +
           (truncation == 0 ? bytes_a_pair * functions * functions : 0);
}

GlobalTransport glossy_operator(const Ground& ground, const PrecomputeOptions& options,
                                const Settings& settings, const Progress& progress,
                                EarlierWork& /*earlier*/, OracleCost& cost, StageClock& clock,
                                PrecomputeReport& report) {
    report.blind_sides = ground.blind_sides;
    const double functions = glossy_functions(ground, options, settings);
    const bool is_whole = !ground.tells_what_matters();
    require_memory(functions,
                   glossy_memory_for(ground, functions, is_whole ? 0 : settings.truncation),
                   glossy_memory_for(ground, functions, is_whole ? 0 : 1), options.max_memory);
    OracleCost links_cost;
    DirectedBounce bounce =
        directed_bounce(ground, bounce_options(ground, options, settings), progress, links_cost);
    cost.rays += links_cost.rays;
    report.links_judged += links_cost.links_judged;
    report.link_rays += links_cost.rays;
    report.closure = bounce.closure;
    report.coefficients_before = bounce.coefficients.size();
    clock.lap("links");

    GlobalTransport transport;
    transport.scene = ground.scene;
    transport.space = std::move(bounce.space);
    transport.reflection = Reflection(transport.scene, transport.space, ground.lobes);
    const auto n = static_cast<Eigen::Index>(transport.space.functions());
    constexpr double rough_share = 0.1;
    const double size = hilbert_schmidt_norm(bounce.coefficients);
    BounceTruncation truncation(transport.space, bounce.closed, std::move(bounce.coefficients),
                                Eigen::ArrayXd::Ones(n));
    const SymmetricOperator rough = truncation.at(truncation.threshold_for(rough_share * size));
    clock.lap("operator");
    const std::vector<DirectedLights> tried =
        projected(transport.space, ground, ground.tried, progress);
    const DirectedWeights weights =
        expected_weights(rough, transport.space, transport.reflection, ground, progress);
    clock.lap("ensemble");
    const TruncationTarget target{0.4 * settings.truncation, settings.truncation};
    transport.bounce = truncated_propagation(std::move(truncation), weights, transport.reflection,
                                             tried, target.bounce, progress);
    clock.lap("operator");
    sum_directed_series(weights, tried, target.global, progress, transport);
    clock.lap("series");
    report.elements = transport.space.elements().size();
    report.cells = transport.space.functions();
    transport.provenance.links = bounce.links + bounce.directed_links;
    return transport;
}

}  // namespace lightwell
