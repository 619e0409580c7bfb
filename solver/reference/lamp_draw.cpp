#include "solver/reference/lamp_draw.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "solver/reference/random_lights.h"

namespace lightwell {

namespace {

enum Stream : std::uint64_t { pilot_stream = 1, chance_stream, position_stream };

}  // namespace

LampDraw::LampDraw(const Scene& scene, const Visibility& visibility, std::uint64_t seed)
    : scene_(scene), visibility_(visibility), seed_(seed), random_(seed, chance_stream) {}

/// Of a few lamps, which are not used for anything else.
double LampDraw::mean_stake(const LampStakes& stakes) const {
    constexpr int pilots = 16;
    const std::vector<double> all = stakes(
        positions_in_rooms(scene_, visibility_, pilots, RandomStream(seed_, pilot_stream).bits()));
    return all.empty() ? 0 : std::accumulate(all.begin(), all.end(), 0.0) / pilots;
}

std::vector<DrawnLamp> LampDraw::more(int count, const LampStakes& stakes,
                                      const Progress& progress) {
    // In groups, because telling rooms apart takes time in the square of the places.
    constexpr int group = 64;
    constexpr std::ptrdiff_t at_once = 16;
    const double mean = mean_stake(stakes);
    std::vector<DrawnLamp> lamps;
    while (static_cast<int>(lamps.size()) < count) {
        progress.check();
        if (places_.empty())
            places_ = positions_in_rooms(scene_, visibility_, group,
                                         RandomStream(seed_, position_stream, groups_++).bits());
        if (places_.empty()) return {};
        const std::vector<Vec3> some(
            places_.begin(),
            places_.begin() + std::min(at_once, static_cast<std::ptrdiff_t>(places_.size())));
        const std::vector<double> stake = stakes(some);
        std::ptrdiff_t seen = 0;
        for (; seen < static_cast<std::ptrdiff_t>(some.size()) &&
               static_cast<int>(lamps.size()) < count;
             ++seen) {
            const auto k = static_cast<std::size_t>(seen);
            const double chance = mean > 0 ? std::min(1.0, 0.1 + 0.1 * stake[k] / mean) : 0.2;
            if (random_.uniform() < chance) lamps.push_back({some[k], 1 / chance});
        }
        places_.erase(places_.begin(), places_.begin() + seen);
    }
    return lamps;
}

}  // namespace lightwell
