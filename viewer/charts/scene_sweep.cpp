#include "viewer/charts/scene_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "viewer/charts/operator_sweep.h"

namespace lightwell {

namespace {

/// What is measured for a scene of that many quads.
struct Plan {
    std::vector<double> errors;
    std::vector<double> compressions;  ///< truncation after everything was computed
    std::vector<double> thresholds;    ///< of the truncation study
    double varied_error = 0.05;        ///< whose settings are varied by hand
    double study_error = 0.1;          ///< whose cells the study has
    double most_dense_cells = 0;       ///< that everything is computed for
    int lamps = 0, points = 0;
};

Plan plan_for(std::size_t quads, bool quick) {
    const bool large = quads > 60;
    Plan plan;
    plan.compressions = {0.3, 0.1, 0.03};
    plan.thresholds = {1e-2, 3e-3, 1e-3, 3e-4, 1e-4};
    if (quick) {
        plan.errors =
            large ? std::vector<double>{0.4, 0.2, 0.1} : std::vector<double>{0.3, 0.2, 0.1, 0.05};
        plan.varied_error = large ? 0.2 : 0.1;
        plan.study_error = large ? 0.3 : 0.2;
        plan.most_dense_cells = 1600;
        plan.lamps = 8;
        plan.points = 100;
        plan.thresholds.pop_back();
    } else {
        plan.errors = {0.4, 0.2, 0.1, 0.05, 0.03, 0.02};
        plan.most_dense_cells = 5000;
        plan.lamps = 40;
        plan.points = 150;
        plan.thresholds.push_back(3e-5);
    }
    return plan;
}

/// Threshold of the paper's oracle over the error that it is to reach.
constexpr double paper_tolerance = 0.3;

/// One setting changed by hand: what the default sets, times this.
struct Variation {
    const char* name;
    double cell_size, oracle_tolerance, truncation;
};

/// Up and down by what changes the cost of each noticeably.
constexpr std::array<Variation, 6> variations{{{"cells x 0.7", 0.7, 1, 1},
                                               {"cells x 1.4", 1.4, 1, 1},
                                               {"oracle x 0.3", 1, 0.3, 1},
                                               {"oracle x 3", 1, 3, 1},
                                               {"truncation x 0.6", 1, 1, 0.6},
                                               {"truncation x 1.7", 1, 1, 1.7}}};

/// Tells how much of the work is done.
class Steps {
  public:
    Steps(const Progress& progress, std::size_t all) : progress_(progress), all_(all) {}
    void next() {
        progress_.check();
        progress_.say("chart", static_cast<double>(done_++) / static_cast<double>(all_));
    }

  private:
    const Progress& progress_;
    std::size_t all_, done_ = 0;
};

void append(std::vector<MeasuredSetting>& all, std::vector<MeasuredSetting> more) {
    all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

SceneSweep swept(const Scene& of, const SweepOptions& options, const Progress& progress) {
    const ChartedScene scene(of);
    const Plan plan = plan_for(scene.scene.quads.size(), options.quick);
    Steps steps(progress,
                2 * plan.errors.size() + variations.size() + plan.compressions.size() + 2);
    SceneSweep sweep;
    const auto setting_of = [](double error) { return fmt::format("error {:g}", error); };

    std::optional<JudgedScene> judge;
    Provenance varied;
    double cell_size = 0, cells = 0;
    for (const double error : plan.errors) {
        steps.next();
        PrecomputeOptions asked;
        asked.error = error;
        const BuiltOperator one = built(scene, asked, progress);
        if (!judge) {
            judge.emplace(scene, one.transport, plan.lamps, plan.points, progress);
            cell_size = one.transport.provenance.cell_size;
            cells = one.cells;
        }
        if (error == plan.varied_error) varied = one.transport.provenance;
        append(sweep.settings, measured("default", setting_of(error), one, scene, *judge,
                                        options.scratch, Ways::all));
    }
    sweep.remarks.push_back(fmt::format(
        "Errors are judged by path tracing: {} lamps that no operator was made for, {} places of "
        "the surface each, the same for all settings; bars are 95 % confidence over lamps. Every "
        "operator is built once, from its setting, without attempts to reach an error.",
        plan.lamps, plan.points));

    for (const Variation& change : variations) {
        steps.next();
        PrecomputeOptions asked;
        asked.error = plan.varied_error;
        asked.cell_size = change.cell_size * varied.cell_size;
        asked.oracle_tolerance = change.oracle_tolerance * varied.oracle_tolerance;
        asked.truncation = change.truncation * varied.truncation;
        append(sweep.settings, measured("by hand", change.name, built(scene, asked, progress),
                                        scene, *judge, options.scratch, Ways::gathered));
    }
    sweep.remarks.push_back(fmt::format(
        "By hand, one of the settings that follow from error {:g} is changed at a time. Where none "
        "of these is ringed there, the default is the knee.",
        plan.varied_error));

    for (const double error : plan.errors) {
        steps.next();
        PrecomputeOptions asked;
        asked.error = error;
        asked.oracle = OracleKind::variation;
        asked.oracle_tolerance = paper_tolerance * error;
        const BuiltOperator one = built(scene, asked, progress);
        if (!has_sum(one.transport)) {
            sweep.remarks.push_back(fmt::format(
                "The paper's oracle with threshold {:g} gives an operator that gains energy; its "
                "series has no sum, and it is left out.",
                paper_tolerance * error));
            continue;
        }
        append(sweep.settings,
               measured("paper's oracle", fmt::format("threshold {:g}", paper_tolerance * error),
                        one, scene, *judge, options.scratch, Ways::gathered));
    }

    const double coarser = std::sqrt(std::max(1.0, cells / plan.most_dense_cells));
    for (const double truncation : plan.compressions) {
        steps.next();
        PrecomputeOptions asked;
        asked.error = plan.errors.front();
        asked.cell_size = coarser * cell_size;
        asked.oracle_tolerance = 0;
        asked.truncation = truncation;
        append(sweep.settings,
               measured("compute and compress", fmt::format("truncation {:g}", truncation),
                        built(scene, asked, progress), scene, *judge, options.scratch,
                        Ways::gathered_and_stored));
    }
    if (coarser > 1)
        sweep.remarks.push_back(fmt::format(
            "Everything is computed at the finest level, and compressed then, for cells of at most "
            "{:.2g} m only (about {:.0f}): its cost grows with the square of the cells.",
            coarser * cell_size, plan.most_dense_cells));

    steps.next();
    append(sweep.settings, path_traced(plan.errors, cells, scene, *judge));

    steps.next();
    PrecomputeOptions fine;
    fine.error = plan.study_error;
    fine.truncation = 0.02;
    sweep.truncation = study_of_truncation(built(scene, fine, progress).transport, scene, *judge,
                                           plan.thresholds, progress);
    return sweep;
}

}  // namespace lightwell
