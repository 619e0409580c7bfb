#include "solver/reading/dimmed_light.h"

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

}  // namespace lightwell
