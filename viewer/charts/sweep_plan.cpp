#include "viewer/charts/sweep_plan.h"

namespace lightwell {

SweepPlan sweep_plan(std::size_t quads, bool is_glossy, bool quick) {
    constexpr std::size_t many_quads = 60;
    const bool is_costly = quads > many_quads || is_glossy;
    SweepPlan plan;
    plan.compressions = {0.3, 0.1, 0.03};
    plan.thresholds = {1e-2, 3e-3, 1e-3, 3e-4, 1e-4};
    if (!quick) {
        plan.errors = {0.4, 0.2, 0.1, 0.05, 0.03, 0.02};
        if (is_glossy) plan.errors = {0.4, 0.2, 0.1, 0.05};
        plan.judged_errors = {0.2, 0.1, 0.05};
        plan.thresholds.push_back(3e-5);
        return plan;
    }
    plan.errors = {0.3, 0.2, 0.1, 0.05};
    plan.judged_errors = {0.2, 0.1};
    plan.varied_error = 0.1;
    if (is_costly) {
        plan.errors = {0.4, 0.2, 0.1};
        plan.varied_error = 0.2;
    }
    plan.most_dense_cells = 1600;
    plan.most_whole_cells = 2500;
    // Errors differ more from lamp to lamp than from place to place.
    plan.lamps = 24;
    plan.points = 48;
    plan.thresholds.pop_back();
    return plan;
}

}  // namespace lightwell
