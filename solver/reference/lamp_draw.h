#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "radiance4d/progress.h"
#include "radiance4d/scene/scene.h"
#include "radiance4d/scene/visibility.h"
#include "solver/reference/random_stream.h"

namespace lightwell {

/// A place for a lamp.
struct DrawnLamp {
    Vec3 position = Vec3::Zero();  ///< [m]
    double weight = 1;             ///< the inverse of its chance; >= 1
};

/// What hangs on a lamp at each of some places, >= 0 in any unit.
using LampStakes = std::function<std::vector<double>(const std::vector<Vec3>&)>;

/// Lamps anywhere in the rooms, drawn oftener where much hangs on them.
///
/// A lamp in a narrow gap or close to a wall can be wrong by several times the average, and is
/// rare: forty lamps drawn evenly contain it or not, and know the mean badly without knowing that
/// they do. Lamps that may matter are therefore taken always, the others with a chance of at least
/// a tenth, and each counts by the inverse of its chance. What is taken are independent draws of
/// one distribution, as long as the stakes are the same.
class LampDraw {
  public:
    /// Keeps references to both.
    LampDraw(const Scene& scene, const Visibility& visibility, std::uint64_t seed);

    /// @param stakes  asked for several times as many places as lamps are taken
    /// @return `count` further lamps, or none where there is no room for any
    /// @throws Interrupted if the progress says so
    std::vector<DrawnLamp> more(int count, const LampStakes& stakes, const Progress& progress);

  private:
    double mean_stake(const LampStakes& stakes) const;

    const Scene& scene_;
    const Visibility& visibility_;
    std::uint64_t seed_;
    RandomStream random_;
    std::uint64_t groups_ = 0;  ///< of places that were drawn
    std::vector<Vec3> places_;  ///< of the last one, those that were not come to yet
};

}  // namespace lightwell
