#include "solver/precompute.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "radiance4d/scene/brdf.h"
#include "radiance4d/scene/occluder_tree.h"
#include "radiance4d/scene/visibility.h"
#include "solver/reference/error_estimate.h"
#include "solver/reference/random_lights.h"
#include "solver/series/light_ensemble.h"
#include "solver/series/neumann_series.h"
#include "solver/series/truncation.h"
#include "solver/transport/direct_transport.h"
#include "solver/transport/elements.h"
#include "solver/transport/geometric_oracle.h"
#include "solver/transport/open_masks.h"
#include "solver/transport/refiner.h"
#include "solver/transport/variation_oracle.h"

namespace lightwell {

namespace {

/// Adds the time since the last lap to the named stage.
class StageClock {
  public:
    explicit StageClock(std::map<std::string, double>& seconds) : seconds_(seconds) {}
    ~StageClock() { lap("other"); }
    StageClock(const StageClock&) = delete;
    StageClock& operator=(const StageClock&) = delete;

    void lap(const std::string& stage) {
        const auto now = std::chrono::steady_clock::now();
        const double passed = std::chrono::duration<double>(now - last_).count();
        seconds_[stage] += passed;
        seconds_["total"] += passed;
        last_ = now;
    }

  private:
    std::map<std::string, double>& seconds_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// What follows from the error asked for, where it is not set by hand.
struct Settings {
    double cell_size;         ///< [m]
    double oracle_tolerance;  ///< see the oracles
    double truncation;        ///< relative error from left-out coefficients
};

/// First guesses, from measurements on the sample scenes: the error of a picture falls about as the
/// square root of the oracle's tolerance and, being reconstructed smoothly, faster than the cells
/// shrink.
Settings settings_for(const PrecomputeOptions& options, double distance, std::size_t elements) {
    Settings settings{};
    settings.cell_size =
        options.cell_size.value_or(0.09 * distance * std::pow(options.error / 0.05, 0.35));
    const double crowding =
        std::pow(16.0 / static_cast<double>(std::max<std::size_t>(elements, 16)), 0.15);
    const double tolerance = options.oracle == OracleKind::geometric
                                 ? 1e-4 * std::pow(options.error / 0.05, 1.5) * crowding
                                 : options.error;
    settings.oracle_tolerance = options.oracle_tolerance.value_or(tolerance);
    settings.truncation = options.truncation.value_or(0.33 * options.error);
    return settings;
}

/// Tightens what is not set by hand after an operator came out `missed` times as wrong as asked.
void tighten(const PrecomputeOptions& options, double missed, Settings& settings) {
    const double factor = std::clamp(0.9 / missed, 0.6, 0.9);
    if (!options.oracle_tolerance) settings.oracle_tolerance *= factor * factor;
    if (!options.truncation) settings.truncation *= factor;
    if (!options.cell_size) settings.cell_size *= std::pow(factor, 0.25);
}

std::unique_ptr<Oracle> make_oracle(const PrecomputeOptions& options, const Settings& settings,
                                    const std::vector<Quad>& quads, const Visibility& visibility,
                                    double area) {
    if (options.oracle == OracleKind::variation) {
        VariationOracleOptions variation;
        variation.sender_threshold = settings.oracle_tolerance;
        variation.receiver_threshold = settings.oracle_tolerance;
        return std::make_unique<VariationOracle>(variation, visibility);
    }
    GeometricOracleOptions geometric;
    geometric.tolerance = settings.oracle_tolerance;
    geometric.partial_tolerance = 2 * settings.oracle_tolerance;
    return std::make_unique<GeometricOracle>(geometric, quads, visibility, area);
}

/// Where lights are expected: anywhere that there is room, in rooms rather than in the open. A
/// scene without such a place, a single quad for example, has none; then nothing is weighed.
std::vector<Vec3> light_positions(const Scene& scene, const Visibility& visibility, int count,
                                  std::uint64_t seed) {
    LightPlacement indoors;
    indoors.surrounded = 0.6;
    std::vector<Vec3> positions;
    for (const LightPlacement& placement : {indoors, LightPlacement{}}) {
        try {
            for (const PointLight& light : random_lights(scene, visibility, count, seed, placement))
                positions.push_back(light.position);
            break;
        } catch (const InputError&) {
            positions.clear();
        }
    }
    return positions;
}

/// Removes the elements that no link touches: they see nothing after all.
void drop_unlinked(std::vector<Element>& elements, std::vector<bool>& closed,
                   std::vector<PairLinks>& pairs, std::uint64_t& blind) {
    std::vector<bool> is_linked(elements.size(), false);
    for (const PairLinks& pair : pairs)
        is_linked[pair.receiver] = is_linked[pair.sender] = true;
    std::vector<std::uint32_t> number(elements.size());
    std::vector<Element> linked;
    std::vector<bool> linked_closed;
    for (std::size_t e = 0; e < elements.size(); ++e) {
        number[e] = static_cast<std::uint32_t>(linked.size());
        if (!is_linked[e]) continue;
        linked.push_back(std::move(elements[e]));
        linked_closed.push_back(closed[e]);
    }
    blind += elements.size() - linked.size();
    elements = std::move(linked);
    closed = std::move(linked_closed);
    for (PairLinks& pair : pairs) {
        pair.receiver = number[pair.receiver];
        pair.sender = number[pair.sender];
    }
}

/// M between the scaling functions of whole elements, numbered by element.
SymmetricOperator mean_bounce(const std::vector<Element>& elements,
                              const std::vector<PairLinks>& pairs) {
    const auto n = static_cast<Eigen::Index>(elements.size());
    std::vector<Eigen::Triplet<double>> entries;
    for (const PairLinks& pair : pairs) {
        double exchange = 0;
        for (const LinkValue& link : pair.links)
            exchange += link.exchange;
        entries.emplace_back(
            pair.receiver, pair.sender,
            exchange / std::sqrt(elements[pair.receiver].area() * elements[pair.sender].area()));
    }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return {to_operator(matrix)};
}

/// The threshold under which the coefficients of M may go for an error of `budget` over the
/// ensemble. An unordered pair acts twice, so its weight is the root of both squares.
double bounce_threshold(const std::vector<Coefficient>& coefficients, const Eigen::ArrayXd& weight,
                        double budget) {
    std::vector<double> magnitudes;
    magnitudes.reserve(coefficients.size());
    for (const Coefficient& c : coefficients)
        magnitudes.push_back(std::abs(static_cast<double>(c.value)) *
                             std::max(weight[c.row], weight[c.column]));
    return threshold_for_budget(std::move(magnitudes), budget);
}

double series_threshold(const Eigen::SparseMatrix<double>& matrix, const Eigen::ArrayXd& weight,
                        double budget) {
    std::vector<double> magnitudes;
    magnitudes.reserve(static_cast<std::size_t>(matrix.nonZeros()));
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
        for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, j); it; ++it)
            magnitudes.push_back(std::abs(it.value()) * weight[j]);
    return threshold_for_budget(std::move(magnitudes), budget);
}

/// H for every distinct channel.
void sum_series(const LightEnsemble& ensemble, double budget, const Progress& progress,
                GlobalTransport& transport) {
    const RadianceField rho = reflectance_of(transport.scene, transport.space);
    TruncationRule rule;
    rule.weight = ensemble.direct;
    rule.is_mean.assign(transport.space.functions(), false);
    for (const Element& element : transport.space.elements())
        rule.is_mean[element.first] = true;
    for (int c = 0; c < 3; ++c) {
        for (int earlier = 0; earlier < c; ++earlier)
            if ((rho.col(earlier) == rho.col(c)).all()) {
                transport.channel[static_cast<std::size_t>(c)] =
                    transport.channel[static_cast<std::size_t>(earlier)];
            }
        const bool is_new = c == 0 || !((rho.col(0) == rho.col(c)).all() ||
                                        (c == 2 && (rho.col(1) == rho.col(c)).all()));
        if (!is_new) continue;
        const Eigen::SparseMatrix<double> one_bounce = to_matrix(transport.bounce, rho.col(c));
        rule.threshold = series_threshold(one_bounce, rule.weight, 0.5 * budget);
        NeumannSeries series = neumann_series(one_bounce, rule, progress);
        rule.threshold =
            std::max(rule.threshold, series_threshold(series.sum, rule.weight, budget));
        transport.channel[static_cast<std::size_t>(c)] =
            static_cast<int>(transport.indirect.size());
        transport.indirect.push_back(to_operator(truncated(series.sum, rule)));
        transport.provenance.bounces = std::max(transport.provenance.bounces, series.bounces);
    }
}

/// Memory that a scene of so many cells takes, as measured: links and coefficients before
/// truncation.
void require_memory(const std::vector<Element>& elements, std::uint64_t max_memory) {
    constexpr double bytes_a_cell = 9000;
    double cells = 0;
    for (const Element& element : elements)
        cells += element.functions();
    if (cells * bytes_a_cell > static_cast<double>(max_memory))
        throw InputError(
            fmt::format("the scene has {:.0f} cells at this error, which take about {:.1f} GiB; "
                        "allowed are {:.1f} GiB "
                        "(--max-memory). Ask for a larger --error, or allow more.",
                        cells, cells * bytes_a_cell / 1073741824.0,
                        static_cast<double>(max_memory) / 1073741824.0));
}

/// What does not depend on the settings.
struct Ground {
    explicit Ground(const Scene& the_scene)
        : scene(the_scene), quads(quads_of(the_scene)), visibility(quads), occluders(quads) {}

    static std::vector<Quad> quads_of(const Scene& scene) {
        std::vector<Quad> quads;
        for (const SceneQuad& q : scene.quads)
            quads.push_back(q.quad);
        return quads;
    }

    const Scene& scene;
    std::vector<Quad> quads;
    Visibility visibility;
    OccluderTree occluders;
    std::vector<Element> elements;  ///< not refined
    std::vector<bool> closed;       ///< by element
    double distance = 0;            ///< see typical_distance
    std::vector<Vec3> positions;    ///< where lights can be
    std::vector<Vec3> unseen;       ///< the same, for judging
    std::uint64_t blind_sides = 0;
};

/// Surface points a light to judge at: fewer where the albedo makes the judge's paths long.
int judged_points(const Scene& scene) {
    double albedo = 0;
    for (const Material& material : scene.materials)
        albedo = std::max(albedo, material.reflectance.maxCoeff());
    return std::clamp(static_cast<int>(1000 * (1 - albedo)), 24, 200);
}

/// 1. Elements: sides that can see something, and what they see.
void survey(Ground& ground, OracleCost& cost, PrecomputeReport& report) {
    constexpr int survey_rays = 256;
    constexpr int ensemble_size = 48, judged = 8;
    ground.elements = seeing_elements(ground.scene, ground.blind_sides);
    std::vector<SideSurvey> sides =
        survey_sides(ground.elements, ground.visibility, survey_rays, cost);
    ground.positions = light_positions(ground.scene, ground.visibility, ensemble_size, 20060626);
    ground.unseen = light_positions(ground.scene, ground.visibility, judged, 1);
    report.inside_of_solids =
        drop_inside_of_solids(ground.positions, ground.visibility, cost, ground.elements, sides);
    for (const SideSurvey& side : sides)
        ground.closed.push_back(side.escaped == 0);
    ground.distance = typical_distance(ground.elements, sides);
}

/// 2. to 5.: the operators for given settings.
GlobalTransport build(const Ground& ground, const PrecomputeOptions& options,
                      const Settings& settings, const Progress& progress, OracleCost& cost,
                      StageClock& clock, PrecomputeReport& report) {
    constexpr int most_levels = 6;
    std::vector<Element> elements = ground.elements;
    report.blind_sides = ground.blind_sides;
    set_cells(elements, settings.cell_size, most_levels);
    require_memory(elements, options.max_memory);
    set_open_masks(ground.quads, ground.occluders, ground.visibility, elements, cost);
    clock.lap("elements");

    // 2. Links, as far as the oracle refines them.
    double area = 0;
    for (const Element& element : elements)
        area += element.area();
    const std::unique_ptr<Oracle> oracle =
        make_oracle(options, settings, ground.quads, ground.visibility, area);
    std::vector<PairLinks> pairs =
        refine_links(elements, ground.quads, ground.occluders, *oracle, progress, cost);
    clock.lap("links");

    // 3. Energy: what sampled links lack in closed surroundings.
    std::vector<bool> closed = ground.closed;
    progress.say("closure", 0);
    report.closure = close_links(elements, closed, {}, pairs, progress);
    drop_unlinked(elements, closed, pairs, report.blind_sides);
    clock.lap("closure");

    // 4. The direct transport operator in wavelets, truncated for the lights that can be.
    GlobalTransport transport;
    transport.scene = ground.scene;
    transport.space = RadianceSpace(std::move(elements));
    const std::vector<Coefficient> coefficients =
        direct_transport(transport.space, pairs, progress);
    report.coefficients_before = coefficients.size();
    clock.lap("operator");
    Eigen::ArrayXd albedo(static_cast<Eigen::Index>(transport.space.elements().size()));
    for (std::size_t e = 0; e < transport.space.elements().size(); ++e)
        albedo[static_cast<Eigen::Index>(e)] =
            ground.scene.material_of(transport.space.element(e).quad).reflectance.mean();
    const LightEnsemble ensemble =
        light_ensemble(transport.space, ground.quads, ground.occluders, ground.positions,
                       mean_bounce(transport.space.elements(), pairs), albedo, progress);
    clock.lap("ensemble");
    transport.bounce =
        truncated(transport.space, closed, coefficients, ensemble.total,
                  bounce_threshold(coefficients, ensemble.total, 0.5 * settings.truncation));
    clock.lap("operator");

    // 5. The global transport operator.
    sum_series(ensemble, settings.truncation, progress, transport);
    clock.lap("series");
    report.elements = transport.space.elements().size();
    report.cells = transport.space.functions();
    for (const PairLinks& pair : pairs)
        transport.provenance.links += pair.links.size();
    return transport;
}

/// The pipeline, of a scene without gloss.
GlobalTransport precompute_diffuse(const Scene& scene, const PrecomputeOptions& options,
                                   const Progress& progress, PrecomputeReport& report) {
    StageClock clock(report.seconds);
    OracleCost cost;
    Ground ground(scene);
    survey(ground, cost, report);
    clock.lap("elements");

    Settings settings = settings_for(options, ground.distance, ground.elements.size());
    GlobalTransport transport;
    ErrorEstimate estimate;
    for (report.attempts = 1;; ++report.attempts) {
        transport = build(ground, options, settings, progress, cost, clock, report);
        if (options.most_attempts == 0) break;

        // 6. Is it good enough?
        EstimateOptions judge;
        judge.noise = std::clamp(options.error, 0.03, 0.05);
        judge.points = judged_points(scene);
        estimate = estimate_error(transport, ground.quads, ground.occluders, ground.visibility,
                                  ground.unseen, judge, progress);
        report.estimate_rays += estimate.rays;
        clock.lap("estimate");
        const bool by_hand = options.cell_size && options.oracle_tolerance && options.truncation;
        // Counted in links and not in seconds, so that the result is the same on every machine.
        const bool too_much = transport.provenance.links > options.most_links / 2;
        // The judge looks at few lights and points, so its verdict on one light in ten is granted
        // some noise.
        const double missed = std::max(estimate.rms() / (0.9 * options.error),
                                       estimate.ninth_of_ten() / (1.15 * options.error));
        if (missed <= 1 || by_hand || too_much || report.attempts == options.most_attempts) break;
        tighten(options, missed, settings);
    }
    report.error_by_light = estimate.by_light;
    report.links_judged = cost.links_judged;

    Provenance& provenance = transport.provenance;
    provenance.program = "lightwell";
    provenance.oracle = options.oracle == OracleKind::geometric ? "geometric" : "variation";
    provenance.error_asked = options.error;
    provenance.error_estimated = estimate.rms();
    provenance.energy_dropped = estimate.energy_dropped;
    provenance.cell_size = settings.cell_size;
    provenance.oracle_tolerance = settings.oracle_tolerance;
    provenance.truncation = settings.truncation;
    provenance.rays = cost.rays;
    return transport;
}

}  // namespace

GlobalTransport precompute(const Scene& scene, const PrecomputeOptions& options,
                           const Progress& progress, PrecomputeReport& report) {
    Scene diffuse = scene;
    std::transform(scene.materials.begin(), scene.materials.end(), diffuse.materials.begin(),
                   diffuse_of_equal_albedo);
    GlobalTransport transport = precompute_diffuse(diffuse, options, progress, report);
    transport.scene = scene;
    return transport;
}

}  // namespace lightwell
