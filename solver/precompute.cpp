#include "solver/precompute.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "radiance4d/scene/brdf.h"
#include "solver/diffuse_operator.h"
#include "solver/glossy_operator.h"
#include "solver/ground.h"
#include "solver/reference/error_estimate.h"
#include "solver/settings.h"
#include "solver/stage_clock.h"
#include "solver/tightening.h"

namespace lightwell {

namespace {

/// Lights that the verdict on an operator begins with.
constexpr std::size_t few_lights = 8;

/// Surface points to judge each of the first lights at: fewer where the albedo makes the judge's
/// paths long. Further lights are judged at fewer points, since errors differ more from light to
/// light than from place to place.
int judged_points(const Scene& scene) {
    double albedo = 0;
    for (const Material& material : scene.materials)
        albedo = std::max(albedo, mean_albedo(material).maxCoeff());
    return std::clamp(static_cast<int>(1000 * (1 - albedo)), 24, 200);
}

/// What any operator of the scene should come to for lights that it is not made for: those at the
/// unseen places from `first` on, up to `last`.
std::vector<JudgedLight> judge(const Ground& ground, const PrecomputeOptions& options,
                               const GlobalTransport& transport, std::size_t first,
                               std::size_t last, const Progress& progress) {
    EstimateOptions asked;
    asked.noise = std::clamp(options.error, 0.03, 0.1);
    constexpr int further_points = 64;
    asked.points = judged_points(ground.scene);
    if (first >= few_lights) asked.points = std::min(asked.points, further_points);
    asked.seed += first;
    const auto place = [&](std::size_t k) {
        return ground.unseen.begin() + static_cast<std::ptrdiff_t>(k);
    };
    return judged_lights(transport, ground.quads, ground.visibility, ground.occluders,
                         {place(first), place(last)}, asked, progress);
}

/// Whether the lights judged so far do not tell if the error is below the one asked for.
bool is_open(const Interval& estimated, double error) {
    return estimated.low <= error && estimated.high > error;
}

/// What the settings are tightened by, so that the bound is below the error asked for, not its
/// estimate only. One light in ten is granted some noise.
double missed_by(const ErrorEstimate& estimate, double error) {
    return std::max({estimate.rms() / (0.9 * error), estimate.interval().high / error,
                     estimate.ninth_of_ten() / (1.15 * error)});
}

/// How an operator is computed: diffuse_operator or glossy_operator.
using OperatorOf = GlobalTransport (*)(const Ground&, const PrecomputeOptions&, const Settings&,
                                       const Progress&, EarlierWork&, OracleCost&, StageClock&,
                                       PrecomputeReport&);

/// What scenes without gloss and with it differ in.
struct Pipeline {
    OperatorOf operator_of;
    Settings (*first_guess)(const PrecomputeOptions&, const Ground&);
    using Way = void (*)(const Ground&, const PrecomputeOptions&, double missed, Settings&);
    /// What makes an operator better: the first, until it is of little use, then the other.
    Way tighten, tighten_else;
    /// Basis functions at given settings, and the memory [bytes] that they take.
    double (*functions)(const Ground&, const PrecomputeOptions&, const Settings&);
    double (*memory)(const Ground&, double functions, double truncation);
    double (*looseness)(const Ground&);  ///< of truncation
    double worth_preview;                ///< functions from which the work is long
};

Settings diffuse_settings(const PrecomputeOptions& options, const Ground& ground) {
    Settings settings = settings_for(options, ground.distance, ground.elements.size());
    if (!options.cell_size)
        settings.gap_cell_size =
            gap_cell_size(ground.gaps, settings.cell_size, ground.area, options.error);
    return settings;
}

void tighten_diffuse(const Ground& /*ground*/, const PrecomputeOptions& options, double missed,
                     Settings& settings) {
    tighten(options, missed, settings);
}

void tighten_diffuse_cells(const Ground& /*ground*/, const PrecomputeOptions& options,
                           double missed, Settings& settings) {
    tighten_cells(options, missed, settings);
}

double diffuse_functions(const Ground& ground, const PrecomputeOptions&, const Settings& settings) {
    return cells_at(ground, settings);
}

double diffuse_memory(const Ground&, double functions, double truncation) {
    return memory_for(functions, truncation);
}

double no_looseness(const Ground&) {
    return 1;
}

constexpr Pipeline diffuse_pipeline = {
    diffuse_operator,  diffuse_settings, tighten_diffuse, tighten_diffuse_cells,
    diffuse_functions, diffuse_memory,   no_looseness,    8000};
constexpr Pipeline glossy_pipeline = {
    glossy_operator,  glossy_settings,   tighten_glossy,   tighten_glossy_cells,
    glossy_functions, glossy_memory_for, glossy_looseness, 50000};

/// How many times the first errors are as large as the others, both given by their squares, for the
/// lights that have both: one light differs more from another than operators do.
double better_by(const std::vector<double>& before, const std::vector<double>& now) {
    double sum_before = 0, sum_now = 0;
    for (std::size_t k = 0; k < std::min(before.size(), now.size()); ++k) {
        sum_before += before[k];
        sum_now += now[k];
    }
    return sum_before > 0 && sum_now > 0 ? std::sqrt(sum_before / sum_now) : 1;
}

/// Operators of one scene, each tighter than the last, and the verdict on the last.
class Attempts {
  public:
    Attempts(OperatorOf operator_of, const Ground& ground, const PrecomputeOptions& options,
             const Progress& progress, OracleCost& cost, StageClock& clock,
             PrecomputeReport& report)
        : operator_of_(operator_of),
          ground_(ground),
          options_(options),
          progress_(progress),
          cost_(cost),
          clock_(clock),
          report_(report) {}

    /// Builds one, judges it if any are judged, and says by how much it missed its error.
    double build_and_judge(const Settings& settings, const Progress& told) {
        GlobalTransport built =
            operator_of_(ground_, options_, settings, told, earlier_, cost_, clock_, report_);
        last_ = std::move(built);
        estimate_ = {};
        note(settings);
        if (options_.most_attempts == 0) return 0;

        // 6. Is it good enough?
        if (judged_.empty()) judge_up_to(few_lights);
        estimate_from(0);
        while (is_open(estimate_.interval(), options_.error) &&
               judged_.size() < ground_.unseen.size()) {
            const std::size_t known = judged_.size();
            judge_up_to(2 * known);
            estimate_from(known);
        }
        clock_.lap("estimate");
        note(settings);
        return missed_by(estimate_, options_.error);
    }

    /// Null before the first one is built.
    const GlobalTransport* last() const { return last_ ? &*last_ : nullptr; }
    GlobalTransport take() { return std::move(*last_); }

  private:
    /// Judges further lights, until there are so many.
    void judge_up_to(std::size_t lights) {
        for (JudgedLight& one : judge(ground_, options_, *last_, judged_.size(),
                                      std::min(lights, ground_.unseen.size()), progress_)) {
            report_.estimate_rays += one.rays;
            judged_.push_back(std::move(one));
        }
    }

    void estimate_from(std::size_t first) {
        add_errors(*last_, ground_.quads, ground_.occluders, judged_, first, progress_, estimate_);
    }

    void note(const Settings& settings) {
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

    OperatorOf operator_of_;
    const Ground& ground_;
    const PrecomputeOptions& options_;
    const Progress& progress_;
    OracleCost& cost_;
    StageClock& clock_;
    PrecomputeReport& report_;
    EarlierWork earlier_;
    std::optional<GlobalTransport> last_;
    std::vector<JudgedLight> judged_;
    ErrorEstimate estimate_;
};

/// The first guess, with what an earlier operator taught.
Settings first_settings(const Pipeline& pipeline, const PrecomputeOptions& options,
                        const Ground& ground) {
    Settings settings = pipeline.first_guess(options, ground);
    if (!options.earlier) return settings;
    const double guessed = error_guessed_for(*options.earlier) / pipeline.looseness(ground);
    const double missed = guessed > 0 ? options.earlier->error_estimated / (0.9 * guessed) : 0;
    if (missed > 1) pipeline.tighten(ground, options, missed, settings);
    // Finer cells than guessed were found to be needed.
    if (!options.cell_size && options.error <= options.earlier->error_asked)
        settings.cell_size = std::min(settings.cell_size, options.earlier->cell_size);
    return settings;
}

/// The settings of a preview, which takes a few per cent of the time; none where the work is short
/// or hardly longer than that.
std::optional<Settings> preview_settings(const Pipeline& pipeline, const PrecomputeOptions& options,
                                         const Ground& ground, const Settings& settings) {
    constexpr double coarse = 0.3, shortest_worth = 0.15;
    const bool by_hand = options.cell_size || options.oracle_tolerance || options.truncation;
    if (!options.preview || by_hand || options.most_attempts == 0 ||
        options.error > shortest_worth ||
        pipeline.functions(ground, options, settings) < pipeline.worth_preview)
        return std::nullopt;
    PrecomputeOptions asked = options;
    asked.error = coarse;
    return pipeline.first_guess(asked, ground);
}

/// 2. to 6., again and again, until an operator is good enough or no other is allowed.
void attempt(const Pipeline& pipeline, Attempts& attempts, const Ground& ground,
             const PrecomputeOptions& options, const Progress& progress, PrecomputeReport& report) {
    Settings settings = first_settings(pipeline, options, ground);
    if (const auto preview = preview_settings(pipeline, options, ground, settings)) {
        progress.say("preview", 0);
        Progress silent;
        silent.stop_requested = progress.stop_requested;
        attempts.build_and_judge(*preview, silent);
    }
    // An attempt that was little better than the last is not followed by more of the same; one that
    // was hardly better for either reason by none, which would cost as much as all of them
    // together.
    constexpr double little = 1.15, hardly = 1.05;
    const auto bound = [&](Pipeline::Way way) {
        return [&, way](double missed, Settings& to_tighten) {
            way(ground, options, missed, to_tighten);
        };
    };
    std::array<Tighten, 2> ways = {bound(pipeline.tighten), bound(pipeline.tighten_else)};
    std::vector<double> squares_before;
    bool hardly_before = false;
    for (report.attempts = 1;; ++report.attempts) {
        const double missed = attempts.build_and_judge(settings, progress);
        if (missed <= 1 || report.attempts >= options.most_attempts) return;
        if (report.attempts > 1) {
            const double better = better_by(squares_before, report.squared_errors);
            if (better < hardly && hardly_before) return;
            if (better < little) std::swap(ways[0], ways[1]);
            hardly_before = hardly_before || better < hardly;
        }
        squares_before = report.squared_errors;
        const std::uint64_t links = attempts.last()->provenance.links;
        const auto memory = [&](const Settings& tighter) {
            const double functions = pipeline.functions(ground, options, tighter);
            return std::max(pipeline.memory(ground, functions, tighter.truncation),
                            memory_for_links(links, settings, tighter));
        };
        const auto tighter = tighter_settings(settings, missed, ways, memory,
                                              static_cast<double>(options.max_memory));
        if (!tighter) return;  // what there is, is better than a failure
        settings = *tighter;
    }
}

/// The pipeline, of a scene with gloss or without.
GlobalTransport precompute_alike(const Scene& scene, const Pipeline& pipeline,
                                 const PrecomputeOptions& options, const Progress& progress,
                                 PrecomputeReport& report) {
    StageClock clock(report.seconds);
    OracleCost cost;
    // 1. Elements: sides that can see something, and what they see.
    const Ground ground(scene, cost, options.lobes);
    report.inside_of_solids = ground.inside_of_solids;
    clock.lap("elements");

    Attempts attempts(pipeline.operator_of, ground, options, progress, cost, clock, report);
    try {
        attempt(pipeline, attempts, ground, options, progress, report);
    } catch (const Interrupted&) {
        if (attempts.last() == nullptr) throw;
        report.interrupted = true;
    }
    return attempts.take();
}

/// Whether any quad is glossy; materials that nothing is made of cost nothing.
bool has_gloss(const Scene& scene) {
    for (std::size_t q = 0; q < scene.quads.size(); ++q)
        if (is_glossy(scene.material_of(static_cast<int>(q)))) return true;
    return false;
}

}  // namespace

GlobalTransport precompute(const Scene& scene, const PrecomputeOptions& options,
                           const Progress& progress, PrecomputeReport& report) {
    if (has_gloss(scene) && !options.diffuse) {
        PrecomputeOptions by_directions = options;
        by_directions.oracle = OracleKind::geometric;
        return precompute_alike(scene, glossy_pipeline, by_directions, progress, report);
    }
    Scene diffuse = scene;
    std::transform(scene.materials.begin(), scene.materials.end(), diffuse.materials.begin(),
                   diffuse_of_equal_albedo);
    GlobalTransport transport =
        precompute_alike(diffuse, diffuse_pipeline, options, progress, report);
    transport.scene = scene;
    return transport;
}

}  // namespace lightwell
