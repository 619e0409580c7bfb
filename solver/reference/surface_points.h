#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/scene/scene.h"
#include "radiance4d/scene/visibility.h"

namespace lightwell {

/// A place where irradiance is asked for.
struct SurfacePoint {
    Vec3 position = Vec3::Zero();  ///< [m]
    Vec3 normal = Vec3::UnitZ();   ///< unit, towards the side that is asked about
    int quad = free_point;         ///< quad it lies on, or free_point for a sensor in mid-air
};

/// One side of one quad.
struct QuadSide {
    int quad = 0;
    bool front = true;
};

/// Sides that reflect some light and from which a ray can reach some quad. A side is given up as
/// seeing nothing after `rays` rays, spread over its area and directions, have all escaped.
std::vector<QuadSide> seeing_sides(const Scene& scene, const Visibility& visibility, int rays = 256,
                                   std::uint64_t seed = 1);

/// `count` points spread evenly by area over the given sides; the same for the same seed.
/// @throws InputError if there are no sides, or they have no area.
std::vector<SurfacePoint> sample_surface(const Scene& scene, const std::vector<QuadSide>& sides,
                                         int count, std::uint64_t seed);

}  // namespace lightwell
