#pragma once

#include <vector>

#include "radiance4d/scene/light.h"

namespace lightwell {

/// A light as files and windows hold it.
struct DimmedLight {
    Light light;        ///< at its full intensity
    double dimmer = 1;  ///< factor of it, in [0,1]
    bool on = true;     ///< else it is dark, whatever its dimmer
};

/// The lights as they shine.
std::vector<Light> shining(const std::vector<DimmedLight>& lights);
/// Lights that are on and not dimmed.
std::vector<DimmedLight> undimmed(const std::vector<Light>& lights);

}  // namespace lightwell
