#include "radiance4d/scene/visibility.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// The closed box [0,s]^3 shifted by `offset`, normals inwards.
std::vector<Quad> box(double s, const Vec3& offset) {
    const auto at = [&](double x, double y, double z) -> Vec3 {
        return offset + s * Vec3(x, y, z);
    };
    return {Quad{{at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)}},
            Quad{{at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)}},
            Quad{{at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0)}},
            Quad{{at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)}},
            Quad{{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)}},
            Quad{{at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)}}};
}

class VisibilityAtScale : public ::testing::TestWithParam<double> {};

// A ray from a point on a wall of an empty closed box always arrives, and at the right wall, at any
// scale and far from the origin: no self-hits, no leaks.
TEST_P(VisibilityAtScale, EmptyBoxHidesNothingAndLeaksNothing) {
    const double scale = GetParam();
    const std::vector<Quad> quads = box(scale, scale * Vec3(37, -11, 5));
    const Visibility visibility(quads);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int k = 0; k < 20000; ++k) {
        const int i = static_cast<int>(6 * uniform(random)) % 6;
        const int j = (i + 1 + static_cast<int>(5 * uniform(random)) % 5) % 6;
        const Vec3 a = quads[static_cast<std::size_t>(i)].point(uniform(random), uniform(random));
        const Vec3 b = quads[static_cast<std::size_t>(j)].point(uniform(random), uniform(random));
        ASSERT_FALSE(visibility.occluded(a, i, b, j)) << "from wall " << i << " to " << j;
        const Vec3 direction = (b - a).normalized();
        if (std::abs(direction.dot(quads[static_cast<std::size_t>(i)].normal())) < 1e-3) continue;
        const Hit hit = visibility.nearest(a, i, direction);
        ASSERT_GE(hit.quad, 0) << "leaked from wall " << i << " towards " << j;
        ASSERT_NEAR(hit.distance, (b - a).norm(), 2e-4 * scale);
        ASSERT_TRUE(hit.front);
    }
}

INSTANTIATE_TEST_SUITE_P(Scales, VisibilityAtScale, ::testing::Values(1e-3, 1.0, 1e3));

TEST(Visibility, BlockerBetweenTwoWallsBlocks) {
    std::vector<Quad> quads = box(1, Vec3::Zero());
    quads.push_back(Quad{{Vec3(0.5, 0.25, 0.25), Vec3(0.5, 0.75, 0.25), Vec3(0.5, 0.75, 0.75),
                          Vec3(0.5, 0.25, 0.75)}});
    const Visibility visibility(quads);
    EXPECT_TRUE(visibility.occluded(Vec3(0, 0.5, 0.5), 0, Vec3(1, 0.5, 0.5), 1));
    EXPECT_FALSE(visibility.occluded(Vec3(0, 0.1, 0.1), 0, Vec3(1, 0.1, 0.1), 1));
    EXPECT_FALSE(visibility.occluded(Vec3(0, 0.5, 0.5), 0, Vec3(0.5, 0.5, 0.5), 6));
}

TEST(Visibility, AnEmptySceneHidesNothing) {
    const Visibility visibility({});
    EXPECT_FALSE(visibility.occluded(Vec3(0, 0, 0), free_point, Vec3(1, 0, 0), free_point));
    EXPECT_FALSE(visibility.nearest(Vec3(0, 0, 0), free_point, Vec3::UnitX()));
}

}  // namespace
}  // namespace lightwell
