#include "radiance4d/scene/dimmed_light.h"

namespace lightwell {

std::vector<Light> shining(const std::vector<DimmedLight>& lights) {
    std::vector<Light> shining;
    for (const DimmedLight& dimmed : lights) {
        shining.push_back(dimmed.light);
        std::visit([&](auto& any) { any.intensity *= dimmed.on ? dimmed.dimmer : 0; },
                   shining.back());
    }
    return shining;
}

std::vector<DimmedLight> undimmed(const std::vector<Light>& lights) {
    std::vector<DimmedLight> all;
    for (const Light& light : lights)
        all.push_back({light});
    return all;
}

}  // namespace lightwell
