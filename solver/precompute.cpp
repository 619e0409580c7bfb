#include "solver/precompute.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "radiance4d/scene/brdf.h"
#include "solver/attempts.h"
#include "solver/ground.h"
#include "solver/pipeline.h"
#include "solver/stage_clock.h"
#include "solver/tightening.h"

namespace lightwell {

namespace {

/// How many times the first errors are as large as the others, both given by their squares, for the
/// lights that have both: one light differs more from another than operators do.
double better_by(const std::vector<WeighedValue>& before, const std::vector<WeighedValue>& now) {
    double sum_before = 0, sum_now = 0;
    for (std::size_t k = 0; k < std::min(before.size(), now.size()); ++k) {
        sum_before += before[k].weight * before[k].value;
        sum_now += now[k].weight * now[k].value;
    }
    return sum_before > 0 && sum_now > 0 ? std::sqrt(sum_before / sum_now) : 1;
}

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
    std::vector<WeighedValue> squares_before;
    bool hardly_before = false;
    for (report.attempts = 1;; ++report.attempts) {
        double missed = 0;
        try {
            missed = attempts.build_and_judge(settings, progress);
        } catch (const MemoryExceeded&) {
            if (--report.attempts == 0) throw;
            return;  // as below
        }
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

}  // namespace

bool has_gloss(const Scene& scene) {
    for (std::size_t q = 0; q < scene.quads.size(); ++q)
        if (is_glossy(scene.material_of(static_cast<int>(q)))) return true;
    return false;
}

GlobalTransport precompute(const Scene& scene, const PrecomputeOptions& options,
                           const Progress& progress, PrecomputeReport& report) {
    if (has_gloss(scene) && !options.diffuse) {
        PrecomputeOptions by_directions = options;
        by_directions.oracle = OracleKind::geometric;
        return precompute_alike(scene, glossy_pipeline(), by_directions, progress, report);
    }
    Scene diffuse = scene;
    std::transform(scene.materials.begin(), scene.materials.end(), diffuse.materials.begin(),
                   diffuse_of_equal_albedo);
    GlobalTransport transport =
        precompute_alike(diffuse, diffuse_pipeline(), options, progress, report);
    transport.scene = scene;
    return transport;
}

}  // namespace lightwell
