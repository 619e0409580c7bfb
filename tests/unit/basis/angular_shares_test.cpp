// Light through a direction belongs to the angular cells around it.
#include "radiance4d/basis/angular_shares.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "radiance4d/basis/angular_reflection.h"
#include "radiance4d/basis/direction_map.h"

namespace lightwell {
namespace {

constexpr int levels = 3;

const CellTree& tree() {
    static const CellTree angles = angular_basis(levels).tree();
    return angles;
}

Vec2 centre_of(std::uint32_t cell) {
    const ParameterRect r = tree().rect({levels, cell});
    return {0.5 * (r.u0 + r.u1), 0.5 * (r.v0 + r.v1)};
}

TEST(AngularShares, AtACentreAllBelongsToItsCell) {
    for (std::uint32_t cell = 0; cell < tree().functions(); ++cell) {
        double own = 0;
        for (const AngularShare& one :
             angular_shares(tree(), levels, 3 * direction_from_square(centre_of(cell))))
            own += one.cell == cell ? one.share : 0;
        EXPECT_NEAR(own, 1, 1e-9) << cell;
    }
}

// What is linear over the angular square is the same between the centres.
TEST(AngularShares, InterpolateLinearly) {
    const auto linear = [](const Vec2& st) { return 1 + 2 * st[0] - 0.7 * st[1]; };
    for (const Vec2& st : {Vec2(0.3, 0.41), Vec2(0.5, 0.5), Vec2(0.07, 0.9), Vec2(0.62, 0.11)}) {
        double between = 0, sum = 0;
        for (const AngularShare& one : angular_shares(tree(), levels, direction_from_square(st))) {
            EXPECT_GE(one.share, 0);
            between += one.share * linear(centre_of(one.cell));
            sum += one.share;
        }
        EXPECT_NEAR(between, linear(st), 1e-9);
        EXPECT_NEAR(sum, 1, 1e-12);
    }
}

// On every level: each cell gets its part of all directions, so that uniform light stays uniform.
TEST(AngularShares, AddUpToTheSizeOfEveryCell) {
    constexpr int n = 128;
    for (int level = 0; level <= levels; ++level) {
        std::vector<double> got(std::size_t{1} << (2 * level), 0.0);
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                for (const AngularShare& one : angular_shares(
                         tree(), level, direction_from_square({(i + 0.5) / n, (j + 0.5) / n})))
                    got[one.cell] += one.share / (n * n);
        for (const double share : got)
            EXPECT_NEAR(share * static_cast<double>(got.size()), 1, 1e-6) << level;
    }
}

}  // namespace
}  // namespace lightwell
