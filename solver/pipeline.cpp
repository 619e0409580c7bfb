#include "solver/pipeline.h"

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
