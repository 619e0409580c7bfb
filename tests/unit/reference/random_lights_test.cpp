#include "solver/reference/random_lights.h"

#include <algorithm>
#include <cmath>

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

/// Largest distance [m] between lights of a turned and moved room and those lights turned and
/// moved.
double left_behind(const LightPlacement& placement) {
    const Eigen::Affine3d by =
        Eigen::Translation3d(100, -20, 7) * Eigen::AngleAxisd(0.65, Vec3(1, 2, 3).normalized());
    const Scene scene = box_scene({3, 2, 2.5}, grey());
    Scene moved = scene;
    for (SceneQuad& q : moved.quads)
        for (Vec3& v : q.quad.vertex)
            v = by * v;
    const std::vector<PointLight> here =
        random_lights(scene, visibility_of(scene), 50, 1, placement);
    const std::vector<PointLight> there =
        random_lights(moved, visibility_of(moved), 50, 1, placement);
    double farthest = 0;
    for (std::size_t k = 0; k < here.size(); ++k)
        farthest = std::max(farthest, (by * here[k].position - there[k].position).norm());
    return farthest;
}

TEST(RandomLights, TurnAndMoveWithTheScene) {
    EXPECT_LT(left_behind({}), 1e-9);
}

LightPlacement on_chords() {
    LightPlacement placement;
    placement.proposal = LightProposal::on_chords;
    placement.clearance = 0;
    return placement;
}

// Means of the coordinates and of their products over a box, and none in the block.
TEST(RandomLights, OnChordsAreEvenOverTheAir) {
    const Vec3 size(4, 3, 2), low(1, 1, 0), high(3, 2, 1);
    Scene scene = box_scene(size, grey());
    add_block(scene, low, high, Rgb::Constant(0.5));
    constexpr int count = 1000;
    const std::vector<PointLight> lights =
        random_lights(scene, visibility_of(scene), count, 3, on_chords());
    Vec3 mean = Vec3::Zero(), square = Vec3::Zero();
    for (const PointLight& light : lights) {
        EXPECT_FALSE(between(light.position, low, high)) << light.position.transpose();
        mean += light.position / count;
        square += light.position.cwiseAbs2() / count;
    }
    const auto moment = [&](int power, int axis) {
        const auto of_box = [&](const Vec3& from, const Vec3& to) {
            return (to - from).prod() / (to[axis] - from[axis]) *
                   (std::pow(to[axis], power + 1) - std::pow(from[axis], power + 1)) / (power + 1);
        };
        return (of_box(Vec3::Zero(), size) - of_box(low, high)) /
               (size.prod() - (high - low).prod());
    };
    for (int axis = 0; axis < 3; ++axis) {
        const double variance = moment(2, axis) - std::pow(moment(1, axis), 2);
        EXPECT_NEAR(mean[axis], moment(1, axis), 4 * std::sqrt(variance / count)) << axis;
        const double of_square = moment(4, axis) - std::pow(moment(2, axis), 2);
        EXPECT_NEAR(square[axis], moment(2, axis), 4 * std::sqrt(of_square / count)) << axis;
    }
}

TEST(RandomLights, OnChordsTurnAndMoveWithTheScene) {
    EXPECT_LT(left_behind(on_chords()), 1e-5);  // lengths of chords are of single precision
}

// Of its bounding box's diagonal two per cent are 1.8 m, which nothing in it is clear of.
TEST(PositionsInRooms, AreFoundInAHallThatIsLowForItsWidth) {
    const Scene hall = box_scene({80, 40, 3}, grey());
    EXPECT_THROW(random_lights(hall, visibility_of(hall), 8, 1), InputError);
    const std::vector<Vec3> positions = positions_in_rooms(hall, visibility_of(hall), 100, 1);
    ASSERT_EQ(positions.size(), 100U);
    double mean = 0;
    for (const Vec3& position : positions) {
        EXPECT_TRUE(between(position, Vec3(0.1, 0.1, 0.1), Vec3(79.9, 39.9, 2.9)));
        mean += position[0] / 100;
    }
    EXPECT_NEAR(mean, 40, 4 * 80 / std::sqrt(12 * 100.0));
}

TEST(PositionsInRooms, AreFoundInBothOfTwoRoomsFarApart) {
    constexpr double apart = 1000;
    Scene scene = box_scene({4, 3, 2.5}, grey());
    const std::size_t of_one = scene.quads.size();
    for (std::size_t q = 0; q < of_one; ++q) {
        SceneQuad other = scene.quads[q];
        for (Vec3& v : other.quad.vertex)
            v[0] += apart;
        scene.quads.push_back(other);
    }
    int near = 0;
    for (const Vec3& position : positions_in_rooms(scene, visibility_of(scene), 40, 1))
        if (position[0] < 4) ++near;
    EXPECT_GT(near, 8);
    EXPECT_LT(near, 32);
}

TEST(PositionsInRooms, AreNoneWhereThereIsNoRoom) {
    Scene plate;
    add_quad(plate, Quad{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}},
             Rgb::Constant(0.5));
    EXPECT_TRUE(positions_in_rooms(plate, visibility_of(plate), 1, 1).empty());
    EXPECT_TRUE(positions_in_rooms({}, Visibility({}), 1, 1).empty());
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
