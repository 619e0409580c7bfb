#include "radiance4d/scene/scene_quads.h"

namespace lightwell {

std::vector<Quad> quads_of(const std::vector<SceneQuad>& quads) {
    std::vector<Quad> shapes;
    shapes.reserve(quads.size());
    for (const SceneQuad& quad : quads)
        shapes.push_back(quad.quad);
    return shapes;
}

std::vector<Quad> quads_of(const Scene& scene) {
    return quads_of(scene.quads);
}

}  // namespace lightwell
