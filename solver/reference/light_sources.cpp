#include "solver/reference/light_sources.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "radiance4d/scene/brdf.h"

namespace lightwell {

LampSet::LampSet(const std::vector<Light>& lights) {
    double whole = 0;
    for (const Light& light : lights) {
        Lamp lamp;
        lamp.light = light;
        Rgb intensity;
        if (const auto* spot = std::get_if<SpotLight>(&light)) {
            intensity = spot->intensity;
            lamp.axis = spot->direction.normalized();
            lamp.edge_cosine = std::cos(spot->outer_angle * M_PI / 180);
        } else {
            intensity = std::get<PointLight>(light).intensity;
        }
        const double solid_angle = 2 * M_PI * (1 - lamp.edge_cosine);
        lamp.pick = intensity.maxCoeff() * solid_angle;
        if (!(lamp.pick > 0)) continue;
        lamp.pick_density = lamp.pick / solid_angle;
        whole += lamp.pick;
        lamps.push_back(lamp);
    }
    for (Lamp& lamp : lamps) {
        lamp.pick /= whole;
        lamp.pick_density /= whole;
    }
}

const LampSet::Lamp& LampSet::picked(double uniform) const {
    for (const Lamp& lamp : lamps) {
        if (uniform < lamp.pick) return lamp;
        uniform -= lamp.pick;
    }
    return lamps.back();
}

EmitterSet::EmitterSet(const Scene& scene) : density_(scene.quads.size(), 0.0) {
    double whole = 0;
    for (std::size_t q = 0; q < scene.quads.size(); ++q) {
        const Material& material = scene.material_of(static_cast<int>(q));
        const double sides = material.emitting == Sides::both ? 2 : 1;
        const double weight = material.emission.maxCoeff() * scene.quads[q].quad.area() * sides;
        if (!(weight > 0)) continue;
        emitters_.push_back({static_cast<int>(q), weight});
        whole += weight;
    }
    for (Emitter& emitter : emitters_) {
        const auto q = static_cast<std::size_t>(emitter.quad);
        emitter.pick /= whole;
        density_[q] = emitter.pick / scene.quads[q].quad.area();
    }
}

int EmitterSet::picked(double& uniform) const {
    double rest = uniform;
    for (const Emitter& emitter : emitters_) {
        if (rest < emitter.pick) {
            uniform = rest / emitter.pick;
            return emitter.quad;
        }
        rest -= emitter.pick;
    }
    uniform = std::nextafter(1.0, 0.0);
    return emitters_.back().quad;
}

Rgb emitted_from(const Material& material, bool front) {
    return front || material.emitting == Sides::both ? material.emission : Rgb(Rgb::Zero());
}

Rgb albedo_of(const Material& material, bool front) {
    return front || material.reflecting == Sides::both ? mean_albedo(material) : Rgb(Rgb::Zero());
}

double lamp_factor(const SurfacePoint& at, const Vec3& lamp) {
    const Vec3 way = lamp - at.position;
    const double cosine_times_distance = way.dot(at.normal);
    const double distance = way.norm();
    return cosine_times_distance > 0 ? cosine_times_distance / (distance * distance * distance) : 0;
}

}  // namespace lightwell
