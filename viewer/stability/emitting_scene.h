#pragma once

#include <vector>

#include "radiance4d/scene/scene.h"

namespace lightwell::stability {

/// Something black, and emitting quads above it or beside it.
struct EmittingScene {
    Scene scene;
    explicit EmittingScene(const std::vector<Quad>& dark);
    void add(const Quad& emitter, double luminance);
    /// Illuminance [lx] by the exact integral.
    double irradiance(const Vec3& point, const Vec3& normal, int on_quad) const;
};

}  // namespace lightwell::stability
