#pragma once

#include <cstddef>
#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "radiance4d/scene/light.h"
#include "radiance4d/scene/visibility.h"

namespace lightwell {

/// A lamp, and the elements that it hangs so near to that their cells cannot show what it lights.
struct NearLamp {
    Light light;
    std::vector<std::size_t> elements;
};

/// A place that a ray of a near lamp lights.
struct LampSpot {
    std::size_t element = 0;  ///< on which it lies
    Vec3 position = Vec3::Zero();
    Vec3 to_lamp = Vec3::UnitZ();  ///< unit
    Rgb flux = Rgb::Zero();        ///< that the ray carries [lm]
    double density = 0;            ///< of rays there [1/m2], see density_of_rays
};

/// Spots on the elements that lamps hang near to. From afar, what a lamp lights so closely is small
/// and bright, and rays that are drawn at the other end meet it by luck alone; rays from the lamp
/// always do.
std::vector<LampSpot> lamp_spots(const GlobalTransport& transport, const Visibility& visibility,
                                 const std::vector<NearLamp>& lamps);

/// Rays per m2 that a lamp sends to a lit point of an element in lamp_spots, were nothing between.
double density_of_rays(const Light& lamp, const Vec3& point, const Vec3& normal);

}  // namespace lightwell
