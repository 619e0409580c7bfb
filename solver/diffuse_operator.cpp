#include "solver/diffuse_operator.h"

#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "solver/series/calibrated_truncation.h"
#include "solver/series/light_ensemble.h"
#include "solver/transport/direct_transport.h"
#include "solver/transport/elements.h"
#include "solver/transport/open_masks.h"
#include "solver/transport/refiner.h"

namespace lightwell {

namespace {

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

/// The values that belong to the scaling functions of whole elements.
Eigen::ArrayXd of_means(const RadianceSpace& space, const Eigen::ArrayXd& by_function) {
    Eigen::ArrayXd means(static_cast<Eigen::Index>(space.elements().size()));
    for (std::size_t e = 0; e < space.elements().size(); ++e)
        means[static_cast<Eigen::Index>(e)] = by_function[space.element(e).first];
    return means;
}

std::string memory_text(double bytes) {
    const double mebibytes = bytes / 1048576;
    return mebibytes < 1024 ? fmt::format("{:.0f} MiB", mebibytes)
                            : fmt::format("{:.1f} GiB", mebibytes / 1024);
}

double cells_of(const std::vector<Element>& elements) {
    double cells = 0;
    for (const Element& element : elements)
        cells += element.functions();
    return cells;
}

/// The elements refined as far as the settings allow.
std::vector<Element> with_cells(const Ground& ground, const Settings& settings) {
    constexpr int most_levels = 9;
    constexpr double most_for_gaps = 4;  // times as many cells as without
    std::vector<Element> elements = ground.elements;
    set_cells(elements, settings.cell_size, most_levels);
    const double cells = cells_of(elements);
    double finest = settings.gap_cell_size;
    while (finest < settings.cell_size) {
        std::vector<Element> refined = elements;
        set_gap_cells(ground.gaps, settings.cell_size, finest, most_levels, refined);
        if (cells_of(refined) <= most_for_gaps * cells) return refined;
        finest *= 2;
    }
    return elements;
}

/// The links of all pairs. How many there will be is known too badly before (one scene's cells
/// have 70 links each or 3,500, by the tolerance) to be left at what was foreseen.
/// @throws MemoryExceeded  as soon as they and what is made of them cannot stay within it
std::vector<PairLinks> links_within_memory(const std::vector<Element>& elements,
                                           const Ground& ground, const Oracle& oracle,
                                           std::uint64_t max_memory, const Progress& progress,
                                           OracleCost& cost, LinkRecords* records) {
    // Measured at the peak, where there are more than ten million: 30 to 43, and 47 to 69 with
    // what is kept to go on from.
    constexpr std::uint64_t bytes_a_link = 42, with_records = 70;
    const LinkLimits limits{max_memory / bytes_a_link, max_memory / with_records};
    try {
        return refine_links(elements, ground.quads, ground.occluders, oracle, progress, cost,
                            records, limits);
    } catch (const TooManyLinks&) {
        throw MemoryExceeded(fmt::format(
            "at this error there are more than {:.1f} million links between cells, which take "
            "more than the {} that are allowed (--max-memory). Ask for a larger --error, or allow "
            "more.",
            1e-6 * static_cast<double>(limits.most), memory_text(static_cast<double>(max_memory))));
    }
}

/// Direct light of the trial lights.
TrialLights projected_trials(const RadianceSpace& space, const Ground& ground,
                             const Progress& progress) {
    std::vector<Eigen::ArrayXd> fields;
    for (const Vec3& position : ground.tried) {
        progress.check();
        fields.push_back(white_light(space, position, ground.quads, ground.occluders));
    }
    return trial_lights(fields);
}

}  // namespace

double cells_at(const Ground& ground, const Settings& settings) {
    return cells_of(with_cells(ground, settings));
}

double memory_for(double cells, double truncation) {
    // Links and coefficients before truncation, mostly: measured are 16 kB a cell in a building,
    // which is where it matters, and 22 to 34 kB in single rooms at 5 and 2 %.
    constexpr double bytes_a_cell = 20000, bytes_a_pair_of_cells = 120;
    return bytes_a_cell * cells + (truncation == 0 ? bytes_a_pair_of_cells * cells * cells : 0);
}

void require_memory(double cells, double needed, double truncated, std::uint64_t max_memory) {
    const auto allowed = static_cast<double>(max_memory);
    if (needed <= allowed) return;
    const bool by_truncation = truncated <= allowed;
    throw MemoryExceeded(fmt::format(
        "the scene has {:.0f} cells at this error, which {}take about {}; allowed are {} "
        "(--max-memory). {}, or allow more.",
        cells, by_truncation ? "with --truncation 0 " : "", memory_text(needed),
        memory_text(allowed),
        by_truncation ? "Truncate the operator" : "Ask for a larger --error"));
}

GlobalTransport diffuse_operator(const Ground& ground, const PrecomputeOptions& options,
                                 const Settings& settings, const Progress& progress,
                                 EarlierWork& earlier, OracleCost& cost, StageClock& clock,
                                 PrecomputeReport& report) {
    std::vector<Element> elements = with_cells(ground, settings);
    report.blind_sides = ground.blind_sides;
    const double cells = cells_of(elements);
    const bool is_whole = !ground.tells_what_matters();
    require_memory(cells, memory_for(cells, is_whole ? 0 : settings.truncation),
                   memory_for(cells, is_whole ? 0 : 1), options.max_memory);
    set_open_masks(ground.quads, ground.occluders, ground.visibility, elements, cost);
    clock.lap("elements");

    // 2. Links, as far as the oracle refines them.
    double area = 0;
    for (const Element& element : elements)
        area += element.area();
    const std::unique_ptr<Oracle> oracle =
        make_oracle(options, settings, ground.quads, ground.visibility, area);
    if (earlier.cell_size != settings.cell_size || earlier.gap_cell_size != settings.gap_cell_size)
        earlier = {settings.cell_size, settings.gap_cell_size, {}};
    const bool goes_on = options.oracle == OracleKind::geometric && options.most_attempts > 1;
    OracleCost links_cost;
    std::vector<PairLinks> pairs =
        links_within_memory(elements, ground, *oracle, options.max_memory, progress, links_cost,
                            goes_on ? &earlier.links : nullptr);
    cost.rays += links_cost.rays;
    report.links_judged += links_cost.links_judged;
    report.link_rays += links_cost.rays;
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
    for (const PairLinks& pair : pairs)
        transport.provenance.links += pair.links.size();
    const SymmetricOperator means = mean_bounce(transport.space.elements(), pairs);
    std::vector<Coefficient> coefficients =
        direct_transport(transport.space, std::move(pairs), progress);
    report.coefficients_before = coefficients.size();
    clock.lap("operator");
    const Eigen::ArrayXd albedo = reflectance_of(ground.scene, transport.space).rowwise().mean();
    const LightEnsemble ensemble =
        light_ensemble(transport.space, ground.quads, ground.occluders, ground.expected, means,
                       of_means(transport.space, albedo), progress);
    const TrialLights tried = projected_trials(transport.space, ground, progress);
    clock.lap("ensemble");
    const TruncationTarget target{0.4 * settings.truncation, settings.truncation};
    transport.bounce = truncated_bounce(
        BounceTruncation(transport.space, closed, std::move(coefficients), ensemble.total), tried,
        albedo, target, progress);
    clock.lap("operator");

    // 5. The global transport operator.
    sum_series(ensemble.direct, tried, target, progress, transport);
    clock.lap("series");
    report.elements = transport.space.elements().size();
    report.cells = transport.space.functions();
    return transport;
}

}  // namespace lightwell
