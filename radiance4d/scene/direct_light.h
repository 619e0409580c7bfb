#pragma once

#include <vector>

#include "radiance4d/scene/light.h"
#include "radiance4d/scene/occluder_tree.h"
#include "radiance4d/scene/scene.h"
#include "radiance4d/scene/visibility.h"

namespace lightwell {

/// Direct illuminance at points of a scene, with shadows and without sampling.
///
/// Point and spot lights follow the inverse square law, with one shadow ray each. Emitting quads
/// are exact: Lambert's formula over the part of the quad that the point sees. Safe to ask from
/// many threads at once.
class DirectLight {
  public:
    /// Keeps references to all three, which belong to the same quads.
    DirectLight(const Scene& scene, const Visibility& visibility, const OccluderTree& occluders);

    /// Illuminance [lx] at a point with a unit normal, from all emitting quads and the lights
    /// given.
    /// @param on_quad the quad that the point lies on, which hides nothing, or free_point
    Rgb irradiance(const Vec3& point, const Vec3& normal, int on_quad,
                   const std::vector<Light>& lights) const;

    /// The share of one light [lx]. A light at the point itself gives 0.
    Rgb from_light(const Vec3& point, const Vec3& normal, int on_quad, const Light& light) const;

    /// The share of one emitting quad [lx]. From within its plane it gives 0.
    Rgb from_emitter(const Vec3& point, const Vec3& normal, int on_quad, int emitter) const;

    /// Indices of the emitting quads.
    const std::vector<int>& emitters() const { return emitters_; }

  private:
    const Scene& scene_;
    const Visibility& visibility_;
    const OccluderTree& occluders_;
    std::vector<int> emitters_;
};

}  // namespace lightwell
