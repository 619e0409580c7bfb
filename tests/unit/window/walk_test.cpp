#include <cmath>

#include <gtest/gtest.h>

#include "viewer/window/walk_camera.h"
#include "viewer/window/walls.h"

namespace lightwell {
namespace {

/// A wall in the plane y = 0, 4 m wide and 3 m high, its front towards -y.
const Quad wall{{Vec3(-2, 0, 0), Vec3(2, 0, 0), Vec3(2, 0, 3), Vec3(-2, 0, 3)}};

TEST(NearestOn, IsTheFootInsideAndOnTheRimOutside) {
    EXPECT_TRUE(nearest_on(wall, {1, -2, 1}).isApprox(Vec3(1, 0, 1)));
    EXPECT_TRUE(nearest_on(wall, {1, 5, 1}).isApprox(Vec3(1, 0, 1)));
    EXPECT_TRUE(nearest_on(wall, {3, -2, 1}).isApprox(Vec3(2, 0, 1)));
    EXPECT_TRUE(nearest_on(wall, {-3, 1, 4}).isApprox(Vec3(-2, 0, 3)));
    EXPECT_TRUE(nearest_on(wall.reversed(), {3, -2, -1}).isApprox(Vec3(2, 0, 0)));
}

TEST(Walls, StopAWalkerAtTheirRadiusHoweverLongTheStep) {
    const Walls walls({wall}, 0.25);
    for (const double far : {0.1, 1.0, 50.0}) {
        const Vec3 end = walls.walk({0, -1, 1.5}, {0, far, 1.5});
        EXPECT_NEAR(end[1], -0.25, 1e-6) << far;
        EXPECT_NEAR(end[0], 0, 1e-9);
    }
    // From behind as well.
    EXPECT_NEAR(walls.walk({0, 1, 1.5}, {0, -50, 1.5})[1], 0.25, 1e-6);
}

TEST(Walls, LetAWalkerSlideAlongAndPassBeside) {
    const Walls walls({wall}, 0.25);
    const Vec3 slid = walls.walk({-1, -0.5, 1.5}, {1, 0.5, 1.5});
    EXPECT_NEAR(slid[1], -0.25, 1e-3);
    EXPECT_GT(slid[0], 0.5);
    EXPECT_TRUE(walls.walk({3, -1, 1.5}, {3, 1, 1.5}).isApprox(Vec3(3, 1, 1.5)));
}

TEST(Walls, HoldInACorner) {
    const Quad other{{Vec3(2, 0, 0), Vec3(2, -4, 0), Vec3(2, -4, 3), Vec3(2, 0, 3)}};
    const Walls walls({wall, other}, 0.25);
    const Vec3 end = walls.walk({0, -1, 1.5}, {10, 10, 1.5});
    EXPECT_LE(end[0], 1.75 + 1e-6);
    EXPECT_LE(end[1], -0.25 + 1e-6);
    EXPECT_GT(end[0], 1);
}

TEST(Walls, PushAwayWhoStandsTooNearAndDoNotThrowWhoIsSqueezed) {
    const Walls walls({wall}, 0.25);
    EXPECT_NEAR(walls.walk({0, -0.1, 1.5}, {0, -0.1, 1.5})[1], -0.25, 1e-6);
    // Between two walls 0.3 m apart there is no room.
    Quad near = wall;
    for (Vec3& vertex : near.vertex)
        vertex[1] -= 0.3;
    const Walls gap({wall, near}, 0.25);
    const Vec3 stays = gap.walk({0, -0.15, 1.5}, {0.1, -0.15, 1.5});
    EXPECT_TRUE(stays.isApprox(Vec3(0, -0.15, 1.5)));
}

TEST(WalkCamera, StandsAsTheCameraDoes) {
    Camera camera;
    camera.position = {1, 2, 3};
    camera.target = {4, 6, 1};
    camera.vertical_angle = 35;
    for (const Vec3& up : {Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(-1, 0, 0)}) {
        const WalkCamera walker(camera, up);
        EXPECT_TRUE(walker.position().isApprox(camera.position));
        EXPECT_TRUE(walker.forward().isApprox((camera.target - camera.position).normalized()));
        EXPECT_EQ(walker.camera().vertical_angle, 35);
        EXPECT_NEAR(walker.right().dot(up), 0, 1e-12);
        EXPECT_TRUE(walker.right().isApprox(walker.forward().cross(up).normalized()));
    }
}

TEST(WalkCamera, LookingDownKeepsTheTopOfThePicture) {
    Camera camera;
    camera.position = {0, 0, 5};
    camera.target = {0, 0, 0};
    camera.up = {1, 0, 0};
    const WalkCamera walker(camera, {0, 0, 1});
    EXPECT_LT(walker.forward()[2], -0.999);
    EXPECT_TRUE(walker.right().isApprox(Vec3(0, -1, 0)));
}

TEST(WalkCamera, LooksAroundAndStopsBeforeTheZenith) {
    WalkCamera walker({}, Vec3::UnitZ());  // looks along y
    walker.look(90, 0);
    EXPECT_TRUE(walker.forward().isApprox(Vec3(1, 0, 0)));
    walker.look(-90, 30);
    EXPECT_TRUE(walker.forward().isApprox(Vec3(0, std::cos(M_PI / 6), 0.5)));
    walker.look(0, 1000);
    EXPECT_GT(walker.forward()[2], 0.999);
    EXPECT_GT(walker.forward()[1], 0);
    walker.look(0, -2000);
    EXPECT_LT(walker.forward()[2], -0.999);
}

TEST(WalkCamera, WalksAtItsSpeedAlongTheViewAndStraightUp) {
    WalkCamera walker({}, Vec3::UnitZ());
    walker.set_speed(3);
    walker.walk({1, 0, 0}, 0.5, nullptr);
    EXPECT_TRUE(walker.position().isApprox(Vec3(0, 1.5, 0)));
    walker.look(0, 60);
    walker.walk({0, 0, 1}, 1, nullptr);
    EXPECT_TRUE(walker.position().isApprox(Vec3(0, 1.5, 3)));
    const Vec3 before = walker.position();
    walker.walk({1, 1, 0}, 2, nullptr);
    EXPECT_NEAR((walker.position() - before).norm(), 6, 1e-12);
}

TEST(WalkCamera, DoesNotWalkThroughWallsUnlessTold) {
    Camera camera;
    camera.position = {0, -1, 1.5};
    camera.target = {0, 0, 1.5};
    WalkCamera walker(camera, Vec3::UnitZ());
    const Walls walls({wall}, 0.25);
    walker.walk({1, 0, 0}, 10, &walls);
    EXPECT_NEAR(walker.position()[1], -0.25, 1e-6);
    walker.walk({1, 0, 0}, 10, nullptr);
    EXPECT_GT(walker.position()[1], 19);
}

}  // namespace
}  // namespace lightwell
