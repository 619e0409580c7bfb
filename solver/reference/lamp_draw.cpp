#include "solver/reference/lamp_draw.h"

#include <algorithm>
#include <cstddef>

#include "solver/reference/random_lights.h"
#include "solver/reference/random_stream.h"

namespace lightwell {

namespace {

enum Stream : std::uint64_t { pilot_stream = 1, chance_stream, position_stream };

/// Mean stake of a few lamps, which are not used for anything else.
double pilot_mean(const Scene& scene, const Visibility& visibility, std::uint64_t seed,
                  const std::function<double(const Vec3&)>& stake, const Progress& progress) {
    constexpr int pilots = 16;
    double mean = 0;
    for (const Vec3& position :
         positions_in_rooms(scene, visibility, pilots, RandomStream(seed, pilot_stream).bits())) {
        progress.check();
        mean += stake(position) / pilots;
    }
    return mean;
}

}  // namespace

std::vector<DrawnLamp> drawn_lamps(const Scene& scene, const Visibility& visibility, int count,
                                   std::uint64_t seed,
                                   const std::function<double(const Vec3&)>& stake,
                                   const Progress& progress) {
    const double mean = pilot_mean(scene, visibility, seed, stake, progress);
    RandomStream random(seed, chance_stream);
    std::vector<DrawnLamp> lamps;
    // In groups, because telling rooms apart takes time in the square of the positions.
    constexpr int group = 64;
    for (std::uint64_t g = 0; static_cast<int>(lamps.size()) < count; ++g) {
        const std::vector<Vec3> positions = positions_in_rooms(
            scene, visibility, group, RandomStream(seed, position_stream, g).bits());
        if (positions.empty()) return {};
        for (const Vec3& position : positions) {
            if (static_cast<int>(lamps.size()) == count) break;
            progress.check();
            const double stakes = mean > 0 ? stake(position) / mean : 1;
            const double chance = std::min(1.0, 0.1 + 0.1 * stakes);
            if (random.uniform() < chance) lamps.push_back({position, 1 / chance});
        }
    }
    return lamps;
}

}  // namespace lightwell
