#pragma once

#include <vector>

#include "radiance4d/scene/scene.h"

namespace lightwell {

/// The shapes of quads alone, in their order.
std::vector<Quad> quads_of(const std::vector<SceneQuad>& quads);
std::vector<Quad> quads_of(const Scene& scene);

}  // namespace lightwell
