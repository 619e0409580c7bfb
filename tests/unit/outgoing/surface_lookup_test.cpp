#include "runtime/outgoing/surface_lookup.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// A floor and a wall of 4 m x 4 m that meet at x = 0, and a shelf a millimetre above the floor.
class Corner : public ::testing::Test {
  protected:
    const std::vector<Quad> quads_ = {
        Quad{{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(4, 4, 0), Vec3(0, 4, 0)}},
        Quad{{Vec3(0, 0, 0), Vec3(0, 4, 0), Vec3(0, 4, 4), Vec3(0, 0, 4)}},
        Quad{{Vec3(3, 3, 1e-3), Vec3(4, 3, 1e-3), Vec3(4, 4, 1e-3), Vec3(3, 4, 1e-3)}}};
    const OccluderTree occluders_{quads_};
    const SurfaceLookup lookup_{quads_, occluders_};
};

TEST_F(Corner, SensorsLieOnTheQuadThatTheyFaceAlong) {
    const SensorStand on = lookup_.stand({1, 1, 0}, Vec3::UnitZ());
    EXPECT_EQ(on.quad, 0);
    EXPECT_TRUE(on.front);
    EXPECT_FALSE(lookup_.stand({1, 1, 0}, -Vec3::UnitZ()).front);
    // In the edge that both share, the normal decides.
    EXPECT_EQ(lookup_.stand({0, 1, 0}, Vec3::UnitZ()).quad, 0);
    EXPECT_EQ(lookup_.stand({0, 1, 0}, Vec3::UnitX()).quad, 1);
}

TEST_F(Corner, RoundedCoordinatesAreMovedOntoThePlane) {
    const double rounding = 0.5 * lookup_.tolerance();
    for (const double z : {-rounding, rounding}) {
        const SensorStand stand = lookup_.stand({1, 1, z}, Vec3::UnitZ());
        EXPECT_EQ(stand.quad, 0);
        EXPECT_NEAR(stand.point[2], 0, 1e-15);
    }
}

TEST_F(Corner, SensorsOffTheQuadsHangFree) {
    EXPECT_EQ(lookup_.stand({1, 1, 3 * lookup_.tolerance()}, Vec3::UnitZ()).quad, free_point);
    EXPECT_EQ(lookup_.stand({4.001, 1, 0}, Vec3::UnitZ()).quad, free_point);
    const SensorStand free = lookup_.stand({1, 1, 1}, Vec3::UnitZ());
    EXPECT_EQ(free.quad, free_point);
    EXPECT_EQ(free.point, Vec3(1, 1, 1));
}

TEST_F(Corner, TheNearestOfTwoQuadsIsTaken) {
    EXPECT_EQ(lookup_.stand({3.5, 3.5, 1e-3}, Vec3::UnitZ()).quad, 2);
    EXPECT_EQ(lookup_.stand({3.5, 3.5, 0}, Vec3::UnitZ()).quad, 0);
}

TEST_F(Corner, SensorsThatLookAslantAreLiftedToTheSideTheyLookTo) {
    for (const double side : {-1.0, 1.0}) {
        const SensorStand stand = lookup_.stand({1, 1, 0}, Vec3(0, 1, side).normalized());
        EXPECT_EQ(stand.quad, free_point);
        EXPECT_DOUBLE_EQ(stand.point[2], side * lookup_.tolerance());
        EXPECT_EQ(stand.point[0], 1);
    }
}

}  // namespace
}  // namespace lightwell
