#include "radiance4d/basis/angular_shares.h"

#include <algorithm>
#include <cmath>

#include "radiance4d/basis/direction_map.h"

namespace lightwell {

namespace {

/// The two cells around a place along one axis, and the share of the second.
struct Neighbours {
    std::array<std::uint32_t, 2> number;
    double second = 0;
};

Neighbours around(double place, int cells) {
    const double from_centre = place * cells - 0.5;
    const double below = std::floor(from_centre);
    const auto number = [&](int k) {
        return static_cast<std::uint32_t>(std::clamp(static_cast<int>(below) + k, 0, cells - 1));
    };
    const bool between = number(0) != number(1);
    return {{number(0), number(1)}, between ? from_centre - below : 0};
}

}  // namespace

std::array<AngularShare, 4> angular_shares(const CellTree& angle, int level,
                                           const Vec3& direction) {
    if (level == 0) return {AngularShare{0, 1}};
    const Vec2 st = square_from_direction(direction.normalized());
    const Neighbours s = around(st[0], 1 << level), t = around(st[1], 1 << level);
    const int finer = angle.levels() - level;
    std::array<AngularShare, 4> result;
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t i = k & 1U, j = k >> 1U;
        result[k] = {angle.finest_at(s.number[i] << finer, t.number[j] << finer) >> (2 * finer),
                     (i == 1 ? s.second : 1 - s.second) * (j == 1 ? t.second : 1 - t.second)};
    }
    return result;
}

}  // namespace lightwell
