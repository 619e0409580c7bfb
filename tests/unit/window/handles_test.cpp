#include "viewer/window/handles.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// At the origin, looking along y, z up; 90 degrees upright, so f = 240 pixels.
CameraRays straight() {
    Camera camera;
    camera.vertical_angle = 90;
    return {camera, 640, 480};
}

PointLight lamp(const Vec3& position) {
    return {"lamp", position, Rgb::Ones()};
}

TEST(Handles, StandWhereTheLightIsSeenAtOneSizeForAllDistances) {
    for (const double distance : {1.0, 5.0, 100.0}) {
        const HandlePlaces places = handle_places(straight(), lamp({0.25 * distance, distance, 0}));
        ASSERT_TRUE(places.centre);
        EXPECT_NEAR((*places.centre)[0], 320 + 60, 1e-9);
        EXPECT_NEAR((*places.centre)[1], 240, 1e-9);
        // x runs to the right and z upwards, both across the view.
        EXPECT_NEAR((*places.axis[0])[0], 380 + 60, 1e-9);
        EXPECT_NEAR((*places.axis[2])[1], 240 - 60, 1e-9);
        EXPECT_FALSE(places.aim);
    }
    EXPECT_FALSE(handle_places(straight(), lamp({0, -2, 0})).centre);
}

TEST(Handles, AreFoundUnderTheCursor) {
    const HandlePlaces places = handle_places(straight(), lamp({0, 4, 0}));
    EXPECT_EQ(handle_at(places, {321, 238}), Handle::centre);
    EXPECT_EQ(handle_at(places, {350, 243}), Handle::x);
    EXPECT_EQ(handle_at(places, {318, 200}), Handle::z);
    EXPECT_EQ(handle_at(places, {350, 260}), Handle::none);
    // y points away from the eye: nothing there but the centre.
    EXPECT_EQ(handle_at(places, {320, 240}), Handle::centre);
    EXPECT_EQ(handle_at(handle_places(straight(), lamp({0, -4, 0})), {320, 240}), Handle::none);
}

TEST(Handles, TheCentreMovesInThePlaneThatFacesTheEye) {
    HandleDrag drag(straight(), lamp({0, 4, 0}), Handle::centre, {323, 239});
    // 60 pixels at 4 m are 1 m; what was 3 pixels beside the light stays so.
    const Vec3 moved = position_of(drag.moved_to({383, 299}));
    EXPECT_TRUE(moved.isApprox(Vec3(1, 4, -1), 1e-12));
    EXPECT_LT((position_of(drag.moved_to({323, 239})) - Vec3(0, 4, 0)).norm(), 1e-12);
}

TEST(Handles, AnAxisMovesTheLightAlongItAlone) {
    HandleDrag drag(straight(), lamp({0, 4, 0}), Handle::x, {350, 240});
    EXPECT_TRUE(position_of(drag.moved_to({410, 240})).isApprox(Vec3(1, 4, 0), 1e-12));
    // Off the axis counts for nothing to first order.
    const Vec3 beside = position_of(drag.moved_to({410, 250}));
    EXPECT_EQ(beside[1], 4);
    EXPECT_EQ(beside[2], 0);
    EXPECT_NEAR(beside[0], 1, 0.02);
    EXPECT_LT((position_of(drag.moved_to({350, 240})) - Vec3(0, 4, 0)).norm(), 1e-12);
}

TEST(Handles, AnAxisSeenAslantFollowsTheCursor) {
    // The light's y axis is seen from the side of the light; the picture of the moved light lies
    // under the cursor wherever it stands on the axis.
    const CameraRays camera = straight();
    const Vec3 start(1, 4, -0.5);
    const Vec2 grip = camera.project(start);
    HandleDrag drag(camera, lamp(start), Handle::y, grip);
    for (const double y : {2.0, 3.0, 9.0}) {
        const Vec2 cursor = camera.project({1, y, -0.5});
        EXPECT_TRUE(position_of(drag.moved_to(cursor)).isApprox(Vec3(1, y, -0.5), 1e-9));
    }
    // Past the vanishing point there is no place for it: it stays.
    const Vec3 last = position_of(drag.moved_to(camera.project({1, 9, -0.5})));
    EXPECT_EQ(position_of(drag.moved_to({100, 100})), last);
}

TEST(Handles, AnAxisTowardsTheEyeIsNotDragged) {
    HandleDrag drag(straight(), lamp({0, 4, 0}), Handle::y, {320, 240});
    EXPECT_EQ(position_of(drag.moved_to({320, 240})), Vec3(0, 4, 0));
}

TEST(Handles, TheAimTurnsASpotTowardsTheCursor) {
    SpotLight spot;
    spot.position = {0, 4, 0};
    spot.direction = {0, 0, -1};
    const CameraRays camera = straight();
    const HandlePlaces places = handle_places(camera, spot);
    ASSERT_TRUE(places.aim);
    EXPECT_NEAR((*places.aim)[1], 240 + 90, 1e-9);
    EXPECT_EQ(handle_at(places, *places.aim), Handle::aim);
    HandleDrag drag(camera, spot, Handle::aim, *places.aim);
    const auto& turned = std::get<SpotLight>(drag.moved_to({320 + 90, 240}));
    EXPECT_TRUE(turned.direction.isApprox(Vec3(1, 0, 0), 1e-9));
    EXPECT_EQ(turned.position, spot.position);
    // On the light itself no direction is meant.
    const auto& kept = std::get<SpotLight>(drag.moved_to({320, 240}));
    EXPECT_TRUE(kept.direction.isApprox(Vec3(1, 0, 0), 1e-9));
}

}  // namespace
}  // namespace lightwell
