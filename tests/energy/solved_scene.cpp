#include "tests/energy/solved_scene.h"

#include <cmath>

#include "radiance4d/scene/scene_quads.h"
#include "solver/precompute.h"

namespace lightwell::testing {

namespace {

Rgb mean_of(const Element& element, const RadianceField& field) {
    return M_PI / std::sqrt(element.area()) * field.row(element.first).transpose();
}

}  // namespace

RadianceField SolvedScene::total(std::size_t element) const {
    return cell_irradiance(transport.space, element, lighting.direct + lighting.indirect);
}

Rgb SolvedScene::mean_indirect(std::size_t element) const {
    return mean_of(transport.space.element(element), lighting.indirect);
}

Rgb SolvedScene::mean_indirect() const {
    return total_flux(transport.space, lighting.indirect) / transport.space.area();
}

Rgb SolvedScene::mean_total() const {
    return mean_indirect() + total_flux(transport.space, lighting.direct) / transport.space.area();
}

SolvedScene solved_scene(const Scene& scene, const std::vector<Light>& lights, double error,
                         int attempts) {
    PrecomputeOptions options;
    options.error = error;
    options.most_attempts = attempts;
    PrecomputeReport report;
    SolvedScene solved;
    solved.transport = precompute(scene, options, {}, report);
    const std::vector<Quad> quads = quads_of(scene);
    solved.lighting =
        light_scene(solved.transport, lights, quads, OccluderTree(quads), Propagation::solved);
    return solved;
}

}  // namespace lightwell::testing
