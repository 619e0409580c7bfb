#include "solver/attempts.h"

#include <algorithm>

#include "radiance4d/scene/brdf.h"

namespace lightwell {

namespace {

/// Lights that the verdict on an operator begins with, and as many as it may take.
constexpr std::size_t few_lights = 16, most_lights = 128;

/// Surface points to judge each of the first lights at: fewer where the albedo makes the judge's
/// paths long. Further lights are judged at fewer points, since errors differ more from light to
/// light than from place to place.
int judged_points(const Scene& scene) {
    double albedo = 0;
    for (const Material& material : scene.materials)
        albedo = std::max(albedo, mean_albedo(material).maxCoeff());
    return std::clamp(static_cast<int>(500 * (1 - albedo)), 16, 100);
}

/// What any operator of the scene should come to for `count` further lights that it is not made
/// for, drawn oftener where more can be wrong; none where there is no room for any.
/// @param first  how many there are already
std::vector<JudgedLight> judge(const Ground& ground, const PrecomputeOptions& options,
                               const GlobalTransport& transport, LampDraw& lamps, std::size_t first,
                               std::size_t count, const Progress& progress) {
    EstimateOptions asked;
    asked.noise = std::clamp(options.error, 0.03, 0.1);
    constexpr int further_points = 64;
    asked.points = judged_points(ground.scene);
    if (first >= few_lights) asked.points = std::min(asked.points, further_points);
    asked.seed += first;
    const auto stakes = [&](const std::vector<Vec3>& places) {
        progress.check();
        return lamp_stakes(transport, ground.quads, ground.occluders, places);
    };
    std::vector<Vec3> positions;
    std::vector<double> weights;
    for (const DrawnLamp& lamp : lamps.more(static_cast<int>(count), stakes, progress)) {
        positions.push_back(lamp.position);
        weights.push_back(lamp.weight);
    }
    std::vector<JudgedLight> judged = judged_lights(transport, ground.quads, ground.visibility,
                                                    ground.occluders, positions, asked, progress);
    for (std::size_t k = 0; k < judged.size(); ++k)
        judged[k].lamp_weight = weights[k];
    return judged;
}

/// What the bound may come to, as a share of the error asked for. Lights are added only until the
/// verdict is clear, and few of them may miss the rare ones that are far off: of 100 bounds, 0 to
/// 15 are below the true error, by scene.
constexpr double allowed_share = 0.9;

/// Whether the lights judged so far do not tell if the error is below the one asked for.
bool is_open(const Interval& estimated, double error) {
    return estimated.low <= error && estimated.high > allowed_share * error;
}

/// What the settings are tightened by, so that the bound is below the error asked for, not its
/// estimate only. One light in ten is granted some noise.
double missed_by(const ErrorEstimate& estimate, double error) {
    return std::max({estimate.rms() / (allowed_share * error),
                     estimate.interval().high / (allowed_share * error),
                     estimate.ninth_of_ten() / (1.15 * error)});
}

}  // namespace

double Attempts::build_and_judge(const Settings& settings, const Progress& told) {
    GlobalTransport built =
        operator_of_(ground_, options_, settings, told, earlier_, cost_, clock_, report_);
    last_ = std::move(built);
    estimate_ = {};
    note(settings);
    if (options_.most_attempts == 0) return 0;

    // 6. Is it good enough?
    if (judged_.empty()) judge_up_to(few_lights);
    estimate_from(0);
    while (is_open(estimate_.interval(), options_.error) && judged_.size() < most_lights) {
        const std::size_t known = judged_.size();
        judge_up_to(2 * known);
        estimate_from(known);
    }
    clock_.lap("estimate");
    note(settings);
    return missed_by(estimate_, options_.error);
}

/// Judges further lights, until there are so many.
void Attempts::judge_up_to(std::size_t lights) {
    for (JudgedLight& one : judge(ground_, options_, *last_, lamps_, judged_.size(),
                                  std::min(lights, most_lights) - judged_.size(), progress_)) {
        report_.estimate_rays += one.rays;
        judged_.push_back(std::move(one));
    }
}

void Attempts::estimate_from(std::size_t first) {
    add_errors(*last_, ground_.quads, ground_.occluders, judged_, first, progress_, estimate_);
}

void Attempts::note(const Settings& settings) {
    report_.squared_errors = estimate_.squares;
    Provenance& provenance = last_->provenance;
    provenance.program = "lightwell";
    provenance.oracle = options_.oracle == OracleKind::geometric ? "geometric" : "variation";
    provenance.error_asked = options_.error;
    provenance.error_estimated = estimate_.rms();
    provenance.error_bound = estimate_.interval().high;
    if (!estimate_.squares.empty()) provenance.error_basis = basis_of(judged_);
    provenance.energy_dropped = estimate_.energy_dropped();
    provenance.cell_size = settings.cell_size;
    provenance.oracle_tolerance = settings.oracle_tolerance;
    provenance.truncation = settings.truncation;
    provenance.rays = cost_.rays;
}

}  // namespace lightwell
