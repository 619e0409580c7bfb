#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "radiance4d/progress.h"
#include "radiance4d/scene/scene.h"
#include "radiance4d/scene/visibility.h"

namespace lightwell {

/// A place for a lamp.
struct DrawnLamp {
    Vec3 position = Vec3::Zero();  ///< [m]
    double weight = 1;             ///< the inverse of its chance; >= 1
};

/// Lamps anywhere in the rooms, drawn oftener where much hangs on them.
///
/// A lamp in a narrow gap or close to a wall can be wrong by several times the average, and is
/// rare: forty lamps drawn evenly contain it or not, and know the mean badly without knowing that
/// they do. Lamps that may matter are therefore taken always, the others with a chance of at least
/// a tenth, and each counts by the inverse of its chance. What is taken are independent draws of
/// one distribution.
///
/// @param stake  what hangs on a lamp, >= 0 in any unit; asked several times for each that is taken
/// @return `count` lamps, or none where there is no room for any
/// @throws Interrupted if the progress says so
std::vector<DrawnLamp> drawn_lamps(const Scene& scene, const Visibility& visibility, int count,
                                   std::uint64_t seed,
                                   const std::function<double(const Vec3&)>& stake,
                                   const Progress& progress);

}  // namespace lightwell
