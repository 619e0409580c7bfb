#include "solver/reference/random_lights.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/unit/reference/rooms.h"

namespace lightwell {
namespace {

std::array<Rgb, 6> grey() {
    std::array<Rgb, 6> result;
    result.fill(Rgb::Constant(0.5));
    return result;
}

bool between(const Vec3& p, const Vec3& low, const Vec3& high) {
    return (p.array() > low.array()).all() && (p.array() < high.array()).all();
}

TEST(DistanceToQuad, IsToThePlaneTheEdgeOrTheCorner) {
    const Quad square{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}};
    EXPECT_DOUBLE_EQ(distance_to(square, {0.3, 0.6, -2}), 2);
    EXPECT_DOUBLE_EQ(distance_to(square, {-3, 0.5, 4}), 5);
    EXPECT_DOUBLE_EQ(distance_to(square, {3, 4, 6}), 7);
    EXPECT_DOUBLE_EQ(distance_to(square, {0.25, 0, 0}), 0);
}

TEST(RandomLights, FillTheRoomButNotItsSurfacesOrTheBlockInIt) {
    const Vec3 low(0.5, 0.5, 0), high(1.7, 1.6, 1.5);
    Scene scene = box_scene({3, 3, 3}, grey());
    add_block(scene, low, high, Rgb::Constant(0.5));
    const Visibility visibility = visibility_of(scene);
    const std::vector<PointLight> lights = random_lights(scene, visibility, 400, 5);
    ASSERT_EQ(lights.size(), 400U);
    const double clearance = 0.02 * std::sqrt(27.0);
    Vec3 mean = Vec3::Zero();
    for (const PointLight& light : lights) {
        EXPECT_TRUE(between(light.position, Vec3::Zero(), Vec3::Constant(3)));
        EXPECT_FALSE(between(light.position, low, high)) << light.position.transpose();
        for (const SceneQuad& one : scene.quads)
            EXPECT_GE(distance_to(one.quad, light.position), clearance);
        mean += light.position / 400;
        EXPECT_TRUE((light.intensity == 1).all());
    }
    // Centroid of the room less the block, each grown by the clearance: within 4 standard errors.
    const Vec3 inner = Vec3::Constant(3 - 2 * clearance);
    const Vec3 grown_low(0.5 - clearance, 0.5 - clearance, clearance);
    const Vec3 grown = high + Vec3::Constant(clearance) - grown_low;
    const Vec3 centroid =
        (inner.prod() * Vec3::Constant(1.5) - grown.prod() * (grown_low + 0.5 * grown)) /
        (inner.prod() - grown.prod());
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(mean[axis], centroid[axis], 4 * 0.9 / 20);

    EXPECT_EQ(random_lights(scene, visibility, 400, 5)[399].position, lights[399].position);
    EXPECT_NE(random_lights(scene, visibility, 1, 6)[0].position, lights[0].position);
}

TEST(RandomLights, KeepOutOfASolidThatReflectsInFrontOnly) {
    const Vec3 low(0.2, 0.2, 0.2), high(2.8, 2.8, 2.0);
    Scene scene = box_scene({3, 3, 3}, grey());
    add_block(scene, low, high, Rgb::Constant(0.5));
    for (Material& material : scene.materials)
        material.reflecting = Sides::front;
    // Most of the room is the block: its inside would be the largest space if it were allowed.
    for (const PointLight& light : random_lights(scene, visibility_of(scene), 50, 1))
        EXPECT_FALSE(between(light.position, low, high));
}

// Behind a wall that reflects in front only the other walls still reflect, but it is no place for a
// lamp: its author has called that side the inside of something.
TEST(RandomLights, KeepOutOfPlacesBehindBlackBacks) {
    Scene scene = box_scene({3, 3, 3}, grey());
    add_quad(scene, Quad{{Vec3(1, 0, 0), Vec3(1, 3, 0), Vec3(1, 3, 3), Vec3(1, 0, 3)}},
             Rgb::Constant(0.5))
        .reflecting = Sides::front;
    for (const PointLight& light : random_lights(scene, visibility_of(scene), 50, 1))
        EXPECT_GT(light.position[0], 1);
}

TEST(RandomLights, LightBothOfTwoClosedRooms) {
    Scene scene = box_scene({4, 2, 2}, grey());
    add_quad(scene, Quad{{Vec3(2, 0, 0), Vec3(2, 2, 0), Vec3(2, 2, 2), Vec3(2, 0, 2)}},
             Rgb::Constant(0.5));
    int left = 0;
    for (const PointLight& light : random_lights(scene, visibility_of(scene), 50, 1))
        if (light.position[0] < 2) ++left;
    EXPECT_GT(left, 10);
    EXPECT_LT(left, 40);
}

TEST(RandomLights, TurnAndMoveWithTheScene) {
    const Eigen::Affine3d by =
        Eigen::Translation3d(100, -20, 7) * Eigen::AngleAxisd(0.65, Vec3(1, 2, 3).normalized());
    const Scene scene = box_scene({3, 2, 2.5}, grey());
    Scene moved = scene;
    for (SceneQuad& q : moved.quads)
        for (Vec3& v : q.quad.vertex)
            v = by * v;
    const std::vector<PointLight> here = random_lights(scene, visibility_of(scene), 50, 1);
    const std::vector<PointLight> there = random_lights(moved, visibility_of(moved), 50, 1);
    for (std::size_t k = 0; k < here.size(); ++k)
        EXPECT_LT((by * here[k].position - there[k].position).norm(), 1e-9);
}

TEST(RandomLights, ASceneWithoutRoomIsAnError) {
    EXPECT_THROW(random_lights({}, Visibility({}), 1, 1), InputError);
    Scene plate;
    add_quad(plate, Quad{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}},
             Rgb::Constant(0.5));
    EXPECT_THROW(random_lights(plate, visibility_of(plate), 1, 1), InputError);
}

}  // namespace
}  // namespace lightwell
