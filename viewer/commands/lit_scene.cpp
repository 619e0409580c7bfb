#include "viewer/commands/lit_scene.h"

#include "radiance4d/operator/smooth_irradiance.h"
#include "radiance4d/scene/brdf.h"

namespace lightwell {

LitScene::LitScene(const OpenedOperator& opened, const std::vector<Light>& lights)
    : opened_(opened),
      lighting_(light_scene(opened.transport, lights, opened.quads, opened.occluders,
                            Propagation::solved)),
      direct_(opened.transport.scene, opened.visibility, opened.occluders) {
    if (has_angles(opened.transport.space))
        glossy_ = std::make_unique<GlossyLight>(opened.transport, direct_, lights, lighting_);
}

FinalGather LitScene::gather(int strata) const {
    return {opened_.transport, opened_.visibility,
            smooth_irradiance(opened_.transport.space,
                              RadianceField(lighting_.direct + lighting_.indirect)),
            strata, glossy_.get()};
}

SeenLight seen_light(const OpenedOperator& opened, const LitScene& lit,
                     const std::vector<Light>& lights, const std::vector<SmoothSurface>& surfaces,
                     const FinalGather* gather, const Vec3& eye, const Vec3& direction) {
    SeenLight seen;
    const Hit hit = opened.visibility.nearest(eye, free_point, direction);
    if (!hit) return seen;
    const Scene& scene = opened.transport.scene;
    const Material& material = scene.material_of(hit.quad);
    if (hit.front || material.emitting == Sides::both) seen.direct = material.emission;
    if (!hit.front && material.reflecting == Sides::front) return seen;

    const Vec3 point = eye + hit.distance * direction;
    const Vec3 up = opened.quads[static_cast<std::size_t>(hit.quad)].normal();
    const Vec3 normal = hit.front ? up : Vec3(-up);
    const int e = opened.transport.space.element_on(hit.quad, hit.front);
    const auto element = static_cast<std::size_t>(std::max(e, 0));
    const bool glossy = e >= 0 && lit.glossy() != nullptr && lit.glossy()->is_glossy(element);
    Rgb diffuse = material.reflectance;
    if (!glossy && is_glossy(material)) diffuse = mean_albedo(material);

    Rgb irradiance = Rgb::Zero();
    if (gather != nullptr) {
        irradiance = gather->irradiance(point, normal, hit.quad);
    } else if (e >= 0) {
        const Vec2 uv = opened.transport.space.element(element).geometry.parameters(point);
        irradiance = surfaces[element].at(uv[0], uv[1]);
    }
    seen.indirect = diffuse / M_PI * irradiance;
    if (!glossy) {
        seen.direct += diffuse / M_PI * lit.direct().irradiance(point, normal, hit.quad, lights);
        return seen;
    }
    const GatheredRadiance lobe = gather != nullptr
                                      ? gather->from_lobe(element, point, -direction)
                                      : lit.glossy()->from_lobe(element, point, -direction);
    seen.indirect += lobe.indirect;
    seen.direct += lobe.emitted + lit.glossy()->from_lamps(element, point, -direction) +
                   diffuse / M_PI * lit.direct().irradiance(point, normal, hit.quad, {});
    return seen;
}

}  // namespace lightwell
