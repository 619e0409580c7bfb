#include "solver/reference/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "radiance4d/operator/light_projection.h"
#include "radiance4d/scene/brdf.h"
#include "solver/reference/chosen_points.h"
#include "solver/reference/confidence.h"
#include "solver/reference/deviation.h"
#include "solver/reference/radiance_tracer.h"
#include "solver/reference/random_stream.h"
#include "solver/reference/sampling.h"

namespace lightwell {

namespace {

/// The element that a surface point lies on, and its parameters there.
struct PlaceOnElement {
    int element = -1;  ///< -1: on a side that takes no part
    Vec2 uv = Vec2::Zero();
};

PlaceOnElement place_of(const SurfacePoint& point, const RadianceSpace& space,
                        const std::vector<Quad>& quads) {
    const bool front = point.normal.dot(quads[static_cast<std::size_t>(point.quad)].normal()) > 0;
    const int number = space.element_on(point.quad, front);
    if (number < 0) return {};
    return {number,
            space.element(static_cast<std::size_t>(number)).geometry.parameters(point.position)};
}

double visible_share(const RadianceSpace& space, const Visibility& visibility,
                     const SurfacePoint& point) {
    constexpr int looks_along = 4;
    int visible = 0;
    for (int i = 0; i < looks_along; ++i) {
        for (int j = 0; j < looks_along; ++j) {
            const Vec3 direction =
                cosine_direction(point.normal, {(i + 0.5) / looks_along, (j + 0.5) / looks_along});
            const Hit hit = visibility.nearest(point.position, point.quad, direction);
            if (!hit || space.element_on(hit.quad, hit.front) >= 0) ++visible;
        }
    }
    return static_cast<double>(visible) / (looks_along * looks_along);
}

/// Irradiance as pictures show it [lx], by element.
std::vector<SmoothSurface> pictured(const GlobalTransport& transport, const RadianceField& direct) {
    return smooth_irradiance(transport.space, gathered_light(transport, direct));
}

std::vector<PointLight> white_unit_lamps(const std::vector<Vec3>& positions) {
    std::vector<PointLight> lamps;
    for (const Vec3& position : positions) {
        PointLight lamp;
        lamp.position = position;
        lamp.intensity = Rgb::Ones();
        lamps.push_back(lamp);
    }
    return lamps;
}

/// Irradiance of a field at surface points as their cells have it [lx], with steps between them.
std::vector<Rgb> stepwise_at(const std::vector<SurfacePoint>& points, const RadianceSpace& space,
                             const RadianceField& field, const std::vector<Quad>& quads) {
    std::vector<RadianceField> cells(space.elements().size());  // of those that are asked for
    std::vector<Rgb> values;
    for (const SurfacePoint& point : points) {
        const PlaceOnElement place = place_of(point, space, quads);
        values.emplace_back(Rgb::Zero());
        if (place.element < 0) continue;
        const auto e = static_cast<std::size_t>(place.element);
        if (cells[e].rows() == 0) cells[e] = cell_irradiance(space, e, field);
        values.back() =
            cells[e].row(space.element(e).space.tree().finest_around(place.uv[0], place.uv[1]));
    }
    return values;
}

/// Sum of the squared coefficients of the finest wavelets over the surfaces, in all directions.
double finest_details(const RadianceSpace& space, const RadianceField& field) {
    double sum = 0;
    for (const Element& element : space.elements()) {
        const CellTree& tree = element.space.tree();
        if (tree.levels() == 0) continue;
        const std::uint32_t coarser = tree.cells(tree.levels() - 1) * element.angle.functions();
        sum +=
            field.middleRows(element.first + coarser, element.functions() - coarser).square().sum();
    }
    return sum;
}

/// What judging an operator by one light gives.
struct Verdict {
    Deviation deviation;
    Rgb stored_flux = Rgb::Zero();  ///< see ErrorEstimate
    Rgb solved_flux = Rgb::Zero();
};

Verdict verdict_on(const GlobalTransport& transport, const std::vector<Quad>& quads,
                   const OccluderTree& occluders, const JudgedLight& judged, bool solves) {
    const RadianceField direct =
        projected_lights(transport.space, {judged.light}, quads, occluders);
    Verdict verdict;
    verdict.deviation = deviation_from(
        judged.truth, shown_at(judged.points, transport.space, pictured(transport, direct), quads),
        judged.weight);
    if (!solves) return verdict;
    verdict.stored_flux = total_flux(transport.space, global_light(transport, direct) - direct);
    verdict.solved_flux = total_flux(transport.space, solved_light(transport, direct));
    return verdict;
}

}  // namespace

double ErrorEstimate::rms() const {
    double sum = 0, weights = 0;
    for (const WeighedValue& one : squares) {
        sum += one.weight * one.value;
        weights += one.weight;
    }
    return weights > 0 ? std::sqrt(std::max(0.0, sum) / weights) : 0;
}

double ErrorEstimate::energy_dropped() const {
    return solved_flux.sum() > 0 ? 1 - stored_flux.sum() / solved_flux.sum() : 0;
}

Interval ErrorEstimate::interval() const {
    if (squares.size() < 2) return {rms(), rms(), rms()};
    return rms_interval(squares);
}

double ErrorEstimate::ninth_of_ten() const {
    std::vector<WeighedValue> sorted = squares;
    std::sort(sorted.begin(), sorted.end(),
              [](const WeighedValue& a, const WeighedValue& b) { return a.value < b.value; });
    const double all =
        std::accumulate(sorted.begin(), sorted.end(), 0.0,
                        [](double sum, const WeighedValue& one) { return sum + one.weight; });
    // Linear between order statistics: those of equal weights are at 0, 1/(n-1), ..., 1.
    double share_before = 0, error_before = 0, below = 0;
    for (const WeighedValue& one : sorted) {
        const double error = std::sqrt(std::max(0.0, one.value));
        const double share = below > 0 ? below / (all - one.weight) : 0;
        if (share >= 0.9)
            return error_before +
                   (0.9 - share_before) / (share - share_before) * (error - error_before);
        below += one.weight;
        share_before = share;
        error_before = error;
    }
    return error_before;
}

Scene without_emission(Scene scene) {
    for (Material& material : scene.materials)
        material.emission = Rgb::Zero();
    return scene;
}

LightSurvey traced_indirect(const Scene& scene, const Visibility& visibility,
                            const PointLight& lamp, const std::vector<SurfacePoint>& points,
                            const NoiseTarget& target, const PathTracing& how) {
    if (std::none_of(scene.materials.begin(), scene.materials.end(), is_glossy))
        return PathTracer(scene, visibility, {lamp}).indirect_to(target, points, how);
    return RadianceTracer(scene, visibility, {lamp}).indirect_irradiance_to(target, points, how);
}

std::vector<double> visible_shares(const RadianceSpace& space, const Visibility& visibility,
                                   const std::vector<SurfacePoint>& points) {
    std::vector<double> shares;
    shares.reserve(points.size());
    for (const SurfacePoint& point : points)
        shares.push_back(visible_share(space, visibility, point));
    return shares;
}

JudgedLight judged_light(const Scene& dark, const Visibility& visibility, const PointLight& lamp,
                         std::vector<SurfacePoint> points, std::vector<double> weight,
                         const NoiseTarget& target, std::uint64_t seed) {
    PathTracing tracing;
    tracing.samples = 64;
    tracing.seed = seed;
    LightSurvey survey = traced_indirect(dark, visibility, lamp, points, target, tracing);
    return {lamp, std::move(points), std::move(weight), std::move(survey.at), survey.rays};
}

std::vector<Rgb> shown_at(const std::vector<SurfacePoint>& points, const RadianceSpace& space,
                          const std::vector<SmoothSurface>& irradiance,
                          const std::vector<Quad>& quads) {
    std::vector<Rgb> values;
    for (const SurfacePoint& point : points) {
        const PlaceOnElement place = place_of(point, space, quads);
        values.emplace_back(Rgb::Zero());
        if (place.element < 0) continue;
        values.back() =
            irradiance[static_cast<std::size_t>(place.element)].at(place.uv[0], place.uv[1]);
    }
    return values;
}

std::vector<JudgedLight> judged_lights(const GlobalTransport& transport,
                                       const std::vector<Quad>& quads, const Visibility& visibility,
                                       const OccluderTree& occluders,
                                       const std::vector<Vec3>& positions,
                                       const EstimateOptions& options, const Progress& progress) {
    const Scene dark = without_emission(transport.scene);
    const std::vector<QuadSide> sides = seeing_sides(dark, visibility);
    NoiseTarget target;
    target.relative = options.noise;
    target.floor = 0.5;  // bright places are chosen oftener than dark ones
    const std::vector<PointLight> lamps = white_unit_lamps(positions);
    std::vector<ChosenPoints> chosen(lamps.size());
    tbb::parallel_for(std::size_t{0}, lamps.size(), [&](std::size_t k) {
        progress.check();
        const RadianceField direct =
            projected_lights(transport.space, {lamps[k]}, quads, occluders);
        CandidatePoints candidates;
        candidates.points = sample_surface(dark, sides, options.candidates, options.seed + k);
        const RadianceField light = gathered_light(transport, direct);
        candidates.shown = {shown_at(candidates.points, transport.space,
                                     smooth_irradiance(transport.space, light), quads),
                            visible_shares(transport.space, visibility, candidates.points)};
        // Where steps between cells are high, more can be wrong.
        candidates.otherwise = stepwise_at(candidates.points, transport.space, light, quads);
        chosen[k] =
            chosen_points(candidates, options.points, RandomStream(options.seed + k).uniform());
    });
    std::vector<JudgedLight> judged;
    for (std::size_t k = 0; k < lamps.size(); ++k) {
        progress.check();
        progress.say("estimate", static_cast<double>(k) / static_cast<double>(lamps.size()));
        judged.push_back(judged_light(dark, visibility, lamps[k], std::move(chosen[k].points),
                                      std::move(chosen[k].shown.weight), target, options.seed + k));
    }
    return judged;
}

std::vector<double> lamp_stakes(const GlobalTransport& transport, const std::vector<Quad>& quads,
                                const OccluderTree& occluders, const std::vector<Vec3>& places) {
    const std::vector<PointLight> lamps = white_unit_lamps(places);
    std::vector<double> stakes(lamps.size());
    tbb::parallel_for(std::size_t{0}, lamps.size(), [&](std::size_t k) {
        const RadianceField direct =
            projected_lights(transport.space, {lamps[k]}, quads, occluders);
        const RadianceField gathered = gathered_light(transport, direct);
        const RadianceField stored = global_light(transport, direct) - direct;
        const double size = gathered.square().sum();
        const double unsure =
            (gathered - stored).square().sum() + finest_details(transport.space, gathered);
        stakes[k] = size > 0 ? unsure / size : 0;
    });
    return stakes;
}

std::string basis_of(const std::vector<JudgedLight>& judged) {
    std::size_t points = 0;
    for (const JudgedLight& one : judged)
        points += one.points.size();
    return fmt::format(
        "path tracing of {} lamps that the operator was not made for, at {} places in all; bound: "
        "95 % confidence over such lamps",
        judged.size(), points);
}

void add_errors(const GlobalTransport& transport, const std::vector<Quad>& quads,
                const OccluderTree& occluders, const std::vector<JudgedLight>& judged,
                std::size_t first, const Progress& progress, ErrorEstimate& estimate) {
    // Solving for a lamp takes longer than judging it; of flux, lamps lose alike.
    constexpr std::size_t lamps_solved = 8;
    std::vector<Verdict> verdicts(judged.size() - first);
    tbb::parallel_for(std::size_t{0}, verdicts.size(), [&](std::size_t i) {
        progress.check();
        verdicts[i] =
            verdict_on(transport, quads, occluders, judged[first + i], first + i < lamps_solved);
    });
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
        const Verdict& verdict = verdicts[i];
        const double weight = judged[first + i].lamp_weight;
        estimate.stored_flux += weight * verdict.stored_flux;
        estimate.solved_flux += weight * verdict.solved_flux;
        if (verdict.deviation.reference_square > 0)
            estimate.squares.push_back(
                {verdict.deviation.square / verdict.deviation.reference_square, weight});
    }
}

ErrorEstimate estimate_error(const GlobalTransport& transport, const std::vector<Quad>& quads,
                             const OccluderTree& occluders, const std::vector<JudgedLight>& judged,
                             const Progress& progress) {
    ErrorEstimate estimate;
    add_errors(transport, quads, occluders, judged, 0, progress, estimate);
    return estimate;
}

}  // namespace lightwell
