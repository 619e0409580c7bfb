#include "viewer/stability/emitting_scene.h"

#include "radiance4d/scene/direct_light.h"
#include "radiance4d/scene/scene_quads.h"
#include "viewer/stability/case_scenes.h"

namespace lightwell::stability {

EmittingScene::EmittingScene(const std::vector<Quad>& dark) {
    for (const Quad& quad : dark)
        add_quad(scene, quad, 0);
}

void EmittingScene::add(const Quad& emitter, double luminance) {
    add_quad(scene, emitter, 0).emission.setConstant(luminance);
}

double EmittingScene::irradiance(const Vec3& point, const Vec3& normal, int on_quad) const {
    const std::vector<Quad> quads = quads_of(scene);
    const Visibility visibility(quads);
    const OccluderTree occluders(quads);
    return DirectLight(scene, visibility, occluders).irradiance(point, normal, on_quad, {})[0];
}

}  // namespace lightwell::stability
