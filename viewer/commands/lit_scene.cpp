#include "viewer/commands/lit_scene.h"

#include <cmath>
#include <utility>
#include <variant>

#include "radiance4d/operator/light_projection.h"
#include "radiance4d/operator/smooth_irradiance.h"
#include "radiance4d/scene/brdf.h"
#include "solver/reference/random_lights.h"

namespace lightwell {

namespace {

/// Elements that a lamp hangs so near to that their cells cannot show the spot it lights, which is
/// as wide as the lamp is high over them.
std::vector<std::size_t> too_near(const RadianceSpace& space, const Light& light) {
    constexpr double cells_high = 2;
    std::vector<std::size_t> near;
    const auto* lamp = std::get_if<PointLight>(&light);
    if (lamp == nullptr) return near;
    for (std::size_t e = 0; e < space.elements().size(); ++e) {
        const Element& element = space.element(e);
        const Quad& quad = element.geometry;
        const double reach =
            cells_high * std::sqrt(element.area() / element.space.tree().functions());
        const double height = (lamp->position - quad.vertex[0]).dot(quad.normal());
        if (height > 0 && height < reach && distance_to(quad, lamp->position) < reach)
            near.push_back(e);
    }
    return near;
}

}  // namespace

LitScene::LitScene(const OpenedOperator& opened, const std::vector<Light>& lights,
                   LampDirections lamps)
    : opened_(opened),
      lights_(lights),
      lighting_(light_scene(opened.transport, lights, opened.quads, opened.occluders,
                            Propagation::solved, lamps)),
      direct_(opened.transport.scene, opened.visibility, opened.occluders) {
    if (has_angles(opened.transport.space))
        glossy_ = std::make_unique<GlossyLight>(opened.transport, direct_, lights_, lighting_);
}

FinalGather LitScene::gather(int strata) const {
    const RadianceSpace& space = opened_.transport.space;
    RadianceField incident = lighting_.direct + lighting_.indirect;
    ExactLamps exact{&direct_, {}};
    for (const Light& light : lights_) {
        const std::vector<std::size_t> near = too_near(space, light);
        if (near.empty()) continue;
        const RadianceField alone =
            projected_lights(space, {light}, opened_.quads, opened_.occluders);
        for (const std::size_t e : near) {
            const Element& element = space.element(e);
            incident.middleRows(element.first, element.functions()) -=
                alone.middleRows(element.first, element.functions());
        }
        exact.lamps.push_back({light, near});
    }
    return {opened_.transport, opened_.visibility, smooth_irradiance(space, incident), strata,
            glossy_.get(),     std::move(exact)};
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
