#include "solver/glossy_precompute.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "solver/ground.h"
#include "solver/radiance_bounce.h"
#include "solver/reference/error_estimate.h"
#include "solver/series/directed_series.h"
#include "solver/series/light_ensemble.h"
#include "solver/settings.h"
#include "solver/stage_clock.h"

namespace lightwell {

namespace {

/// Settings for surfaces whose light has directions: cells twice as wide as on diffuse ones, since
/// the light that one sees in a glossy surface varies with the place by way of its direction, and a
/// truncation that stays above the noise of the rays that sampled the directions.
Settings glossy_settings(const PrecomputeOptions& options, const Ground& ground) {
    Settings settings = settings_for(options, ground.distance, ground.elements.size());
    constexpr double wider = 2, looser = 2;
    if (!options.cell_size) settings.cell_size *= wider;
    if (!options.truncation) settings.truncation *= looser;
    return settings;
}

/// Direct light of white unit lamps.
TrialLights projected(const RadianceSpace& space, const Ground& ground,
                      const std::vector<Vec3>& positions, const Progress& progress) {
    std::vector<Eigen::ArrayXd> fields;
    for (const Vec3& position : positions) {
        progress.check();
        fields.push_back(white_light(space, position, ground.quads, ground.occluders));
    }
    return trial_lights(fields);
}

RadianceBounceOptions bounce_options(const PrecomputeOptions& options, const Settings& settings) {
    RadianceBounceOptions result;
    result.cell_size = settings.cell_size;
    result.oracle.partial_tolerance =
        result.oracle.partial_tolerance / result.oracle.tolerance * settings.oracle_tolerance;
    result.oracle.tolerance = settings.oracle_tolerance;
    result.angle = angular_resolution(options.error);
    return result;
}

/// The operators for given settings.
GlobalTransport build(const Ground& ground, const PrecomputeOptions& options,
                      const Settings& settings, const Progress& progress, OracleCost& cost,
                      StageClock& clock, PrecomputeReport& report) {
    OracleCost links_cost;
    DirectedBounce bounce =
        directed_bounce(ground, bounce_options(options, settings), progress, links_cost);
    cost.rays += links_cost.rays;
    report.links_judged += links_cost.links_judged;
    report.link_rays += links_cost.rays;
    report.closure = bounce.closure;
    report.coefficients_before = bounce.coefficients.size();
    clock.lap("links");

    GlobalTransport transport;
    transport.scene = ground.scene;
    transport.space = std::move(bounce.space);
    transport.reflection = Reflection(transport.scene, transport.space);
    const auto n = static_cast<Eigen::Index>(transport.space.functions());
    BounceTruncation truncation(transport.space, bounce.closed, std::move(bounce.coefficients),
                                Eigen::ArrayXd::Ones(n));
    const SymmetricOperator untruncated = truncation.at(0);
    clock.lap("operator");
    const TrialLights tried = projected(transport.space, ground, ground.tried, progress);
    const DirectedWeights weights =
        directed_weights(untruncated, transport.space, transport.reflection,
                         projected(transport.space, ground, ground.expected, progress), progress);
    clock.lap("ensemble");
    const TruncationTarget target{0.4 * settings.truncation, settings.truncation};
    transport.bounce = truncated_propagation(std::move(truncation), untruncated, weights,
                                             transport.reflection, tried, target.bounce, progress);
    clock.lap("operator");
    sum_directed_series(weights, tried, target.global, progress, transport);
    clock.lap("series");
    report.elements = transport.space.elements().size();
    report.cells = transport.space.functions();
    transport.provenance.links = bounce.links + bounce.directed_links;
    return transport;
}

}  // namespace

GlobalTransport precompute_glossy(const Scene& scene, const PrecomputeOptions& options,
                                  const Progress& progress, PrecomputeReport& report) {
    StageClock clock(report.seconds);
    OracleCost cost;
    const Ground ground(scene, cost);
    report.inside_of_solids = ground.inside_of_solids;
    report.blind_sides = ground.blind_sides;
    clock.lap("elements");
    const Settings settings = glossy_settings(options, ground);
    report.attempts = 1;
    GlobalTransport transport = build(ground, options, settings, progress, cost, clock, report);

    Provenance& provenance = transport.provenance;
    provenance.program = "lightwell";
    provenance.oracle = "geometric";
    provenance.error_asked = options.error;
    provenance.cell_size = settings.cell_size;
    provenance.oracle_tolerance = settings.oracle_tolerance;
    provenance.truncation = settings.truncation;
    provenance.rays = cost.rays;
    return transport;
}

}  // namespace lightwell
