#pragma once

#include <string>
#include <vector>

#include "radiance4d/scene/dimmed_light.h"
#include "radiance4d/scene/scene.h"

namespace lightwell {

/// Lights and a camera as the TOML that read_lights and read_camera take, numbers to the last bit:
/// a file for --lights and for --camera at once.
std::string lights_and_camera_text(const std::vector<DimmedLight>& lights, const Camera& camera);

}  // namespace lightwell
