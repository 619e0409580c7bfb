#include "solver/precompute.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "radiance4d/scene/occluder_tree.h"
#include "radiance4d/scene/visibility.h"
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

Settings settings_for(const PrecomputeOptions& options, double distance) {
    Settings settings{};
    settings.cell_size = options.cell_size.value_or(0.7 * std::sqrt(options.error) * distance);
    const double tolerance = options.oracle == OracleKind::geometric
                                 ? 0.1 * options.error * options.error
                                 : options.error;
    settings.oracle_tolerance = options.oracle_tolerance.value_or(tolerance);
    settings.truncation = options.truncation.value_or(0.3 * options.error);
    return settings;
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
std::vector<Vec3> light_positions(const Scene& scene, const Visibility& visibility) {
    constexpr int count = 48;
    constexpr std::uint64_t seed = 20060626;
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
void drop_unlinked(std::vector<Element>& elements, std::vector<PairLinks>& pairs,
                   std::uint64_t& blind) {
    std::vector<bool> is_linked(elements.size(), false);
    for (const PairLinks& pair : pairs)
        is_linked[pair.receiver] = is_linked[pair.sender] = true;
    std::vector<std::uint32_t> number(elements.size());
    std::vector<Element> linked;
    for (std::size_t e = 0; e < elements.size(); ++e) {
        number[e] = static_cast<std::uint32_t>(linked.size());
        if (is_linked[e]) linked.push_back(std::move(elements[e]));
    }
    blind += elements.size() - linked.size();
    elements = std::move(linked);
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

}  // namespace

GlobalTransport precompute(const Scene& scene, const PrecomputeOptions& options,
                           const Progress& progress, PrecomputeReport& report) {
    StageClock clock(report.seconds);
    OracleCost cost;
    std::vector<Quad> quads;
    for (const SceneQuad& q : scene.quads)
        quads.push_back(q.quad);

    // 1. Elements: sides that can see something, and what they see.
    const Visibility visibility(quads);
    const OccluderTree occluders(quads);
    std::vector<Element> elements = seeing_elements(scene, report.blind_sides);
    constexpr int survey_rays = 256;
    std::vector<SideSurvey> survey = survey_sides(elements, visibility, survey_rays, cost);
    const std::vector<Vec3> positions = light_positions(scene, visibility);
    report.inside_of_solids = drop_inside_of_solids(positions, visibility, cost, elements, survey);
    const Settings settings = settings_for(options, typical_distance(elements, survey));
    constexpr int most_levels = 6;
    set_cells(elements, settings.cell_size, most_levels);
    set_open_masks(quads, occluders, visibility, elements, cost);
    clock.lap("elements");

    // 2. Links, as far as the oracle refines them.
    double area = 0;
    for (const Element& element : elements)
        area += element.area();
    const std::unique_ptr<Oracle> oracle = make_oracle(options, settings, quads, visibility, area);
    std::vector<PairLinks> pairs =
        refine_links(elements, quads, occluders, *oracle, progress, cost);
    report.links_judged = cost.links_judged;
    clock.lap("links");

    // 3. Energy: what sampled links lack in closed surroundings.
    std::vector<bool> closed;
    for (const SideSurvey& side : survey)
        closed.push_back(side.escaped == 0);
    report.closure = close_links(elements, closed, {}, pairs);
    drop_unlinked(elements, pairs, report.blind_sides);
    clock.lap("closure");

    // 4. The direct transport operator in wavelets, truncated for the lights that can be.
    GlobalTransport transport;
    transport.scene = scene;
    transport.space = RadianceSpace(std::move(elements));
    const std::vector<Coefficient> coefficients =
        direct_transport(transport.space, pairs, progress);
    report.coefficients_before = coefficients.size();
    clock.lap("operator");
    Eigen::ArrayXd albedo(static_cast<Eigen::Index>(transport.space.elements().size()));
    for (std::size_t e = 0; e < transport.space.elements().size(); ++e)
        albedo[static_cast<Eigen::Index>(e)] =
            scene.material_of(transport.space.element(e).quad).reflectance.mean();
    const LightEnsemble ensemble =
        light_ensemble(transport.space, quads, occluders, positions,
                       mean_bounce(transport.space.elements(), pairs), albedo);
    clock.lap("ensemble");
    transport.bounce =
        truncated(transport.space, coefficients, ensemble.total,
                  bounce_threshold(coefficients, ensemble.total, 0.5 * settings.truncation));
    clock.lap("operator");

    // 5. The global transport operator.
    sum_series(ensemble, settings.truncation, progress, transport);
    clock.lap("series");

    // 6. Report.
    report.elements = transport.space.elements().size();
    report.cells = transport.space.functions();
    Provenance& provenance = transport.provenance;
    provenance.program = "lightwell";
    provenance.oracle = options.oracle == OracleKind::geometric ? "geometric" : "variation";
    provenance.error_asked = options.error;
    provenance.cell_size = settings.cell_size;
    provenance.oracle_tolerance = settings.oracle_tolerance;
    provenance.truncation = settings.truncation;
    provenance.rays = cost.rays;
    for (const PairLinks& pair : pairs)
        provenance.links += pair.links.size();
    return transport;
}

}  // namespace lightwell
