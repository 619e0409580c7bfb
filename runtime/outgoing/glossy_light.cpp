#include "runtime/outgoing/glossy_light.h"

#include "radiance4d/basis/direction_map.h"
#include "radiance4d/scene/brdf.h"

namespace lightwell {

namespace {

/// By a material that stands for the element's.
Rgb lamps_reflected(const GlobalTransport& transport, const DirectLight& direct,
                    const std::vector<Light>& lights, std::size_t element, const Material& material,
                    const Vec3& point, const Vec3& direction) {
    const Element& e = transport.space.element(element);
    const Eigen::Matrix3d frame = local_frame(e.geometry);
    const Vec3 towards = frame.transpose() * direction;
    if (!(towards[2] > 0)) return Rgb::Zero();
    Rgb sum = Rgb::Zero();
    for (const Light& light : lights) {
        const Rgb irradiance = direct.from_light(point, frame.col(2), e.quad, light);
        if (!(irradiance > 0).any()) continue;
        const Vec3 in = frame.transpose() * (position_of(light) - point).normalized();
        sum += brdf(material, in, towards) * irradiance;
    }
    return sum;
}

}  // namespace

Rgb lobe_of_lamps(const GlobalTransport& transport, const DirectLight& direct,
                  const std::vector<Light>& lights, std::size_t element, const Vec3& point,
                  const Vec3& direction) {
    Material lobe = transport.scene.material_of(transport.space.element(element).quad);
    lobe.reflectance = Rgb::Zero();
    return lamps_reflected(transport, direct, lights, element, lobe, point, direction);
}

GlossyLight::GlossyLight(const GlobalTransport& transport, const DirectLight& direct,
                         const std::vector<Light>& lights, const Lighting& lighting)
    : transport_(transport),
      direct_(direct),
      lights_(lights),
      has_emitters_(!direct.emitters().empty()),
      indirect_(transport.scene, transport.space, lighting.indirect),
      emitted_(transport.scene, transport.space,
               propagated(transport.bounce, emission_of(transport.scene, transport.space))) {}

Rgb GlossyLight::from(const std::vector<Light>& lamps, std::size_t element, const Vec3& point,
                      const Vec3& direction) const {
    const int quad = transport_.space.element(element).quad;
    return lamps_reflected(transport_, direct_, lamps, element, transport_.scene.material_of(quad),
                           point, direction);
}

Rgb GlossyLight::from_lamps(std::size_t element, const Vec3& point, const Vec3& direction) const {
    return from(lights_, element, point, direction);
}

Rgb GlossyLight::lobe_from_lamps(std::size_t element, const Vec3& point,
                                 const Vec3& direction) const {
    return lobe_of_lamps(transport_, direct_, lights_, element, point, direction);
}

Rgb GlossyLight::of(const GlossyProduct& product, std::size_t element, const Vec3& point,
                    const Vec3& direction) const {
    return product.radiance(element, transport_.space.element(element).geometry.parameters(point),
                            direction);
}

Rgb GlossyLight::indirect(std::size_t element, const Vec3& point, const Vec3& direction) const {
    return of(indirect_, element, point, direction);
}

Rgb GlossyLight::from_emitters(std::size_t element, const Vec3& point,
                               const Vec3& direction) const {
    return has_emitters_ ? of(emitted_, element, point, direction) : Rgb(Rgb::Zero());
}

GatheredRadiance GlossyLight::from_lobe(std::size_t element, const Vec3& point,
                                        const Vec3& direction) const {
    const Vec2 uv = transport_.space.element(element).geometry.parameters(point);
    GatheredRadiance light;
    light.indirect = indirect_.from_lobe(element, uv, direction);
    if (has_emitters_) light.emitted = emitted_.from_lobe(element, uv, direction);
    return light;
}

Rgb GlossyLight::radiance(std::size_t element, const Vec3& point, const Vec3& direction) const {
    return from_lamps(element, point, direction) + indirect(element, point, direction) +
           from_emitters(element, point, direction);
}

}  // namespace lightwell
