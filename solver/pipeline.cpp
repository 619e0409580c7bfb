#include "solver/pipeline.h"

#include <algorithm>

#include "solver/diffuse_operator.h"
#include "solver/glossy_operator.h"

namespace lightwell {

namespace {

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

/// Sides are halved until they are short enough: with a limit that is hardly lower, none may be,
/// and the operator would be the same. A limit of half is one that all fall below.
void tighten_diffuse_cells(const Ground& ground, const PrecomputeOptions& options, double missed,
                           Settings& settings) {
    constexpr double at_least = 1.4, step = 0.9, half = 0.5;
    if (options.cell_size) return;
    const Settings before = settings;
    const double cells = cells_at(ground, before);
    tighten_cells(options, missed, settings);
    double factor = settings.cell_size / before.cell_size;
    while (factor > half && cells_at(ground, settings) < at_least * cells) {
        factor = std::max(half, step * factor);
        settings.cell_size = factor * before.cell_size;
        settings.gap_cell_size = factor * before.gap_cell_size;
    }
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

}  // namespace

Pipeline diffuse_pipeline() {
    return {diffuse_operator,  diffuse_settings, tighten_diffuse, tighten_diffuse_cells,
            diffuse_functions, diffuse_memory,   no_looseness,    8000};
}

Pipeline glossy_pipeline() {
    return {glossy_operator,  glossy_settings,   tighten_glossy,   tighten_glossy_cells,
            glossy_functions, glossy_memory_for, glossy_looseness, 50000};
}

}  // namespace lightwell
