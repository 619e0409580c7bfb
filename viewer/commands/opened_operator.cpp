#include "viewer/commands/opened_operator.h"

#include <utility>

#include "radiance4d/operator/operator_file.h"
#include "radiance4d/scene/scene_quads.h"
#include "solver/reading/scene_reader.h"

namespace lightwell {

OpenedOperator opened(GlobalTransport transport, std::vector<DimmedLight> lights) {
    std::vector<Quad> quads = quads_of(transport.scene);
    Visibility visibility(quads);
    OccluderTree occluders(quads);
    return {std::move(transport), std::move(lights), std::move(quads), std::move(visibility),
            std::move(occluders)};
}

OpenedOperator opened(GlobalTransport transport) {
    std::vector<DimmedLight> lights = undimmed(transport.scene.lights);
    return opened(std::move(transport), std::move(lights));
}

OpenedOperator open_operator(const std::string& path) {
    std::vector<DimmedLight> lights;
    GlobalTransport transport = read_operator_file(path, &lights);
    return opened(std::move(transport), std::move(lights));
}

std::vector<Light> chosen_lights(const std::optional<std::string>& path, const Scene& scene) {
    return path ? read_lights(*path) : scene.lights;
}

}  // namespace lightwell
