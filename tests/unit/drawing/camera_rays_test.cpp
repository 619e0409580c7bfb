#include "runtime/drawing/camera_rays.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// At (1,2,3), looking along +y with z up: x is to the right.
Camera along_y(double vertical_angle) {
    Camera camera;
    camera.position = Vec3(1, 2, 3);
    camera.target = Vec3(1, 7, 3);
    camera.vertical_angle = vertical_angle;
    return camera;
}

TEST(CameraRays, EdgesOfThePictureLieAtHalfTheAngle) {
    const CameraRays rays(along_y(90), 300, 200);
    EXPECT_LT((rays.direction(150, 100) - Vec3(0, 1, 0)).norm(), 1e-15);
    EXPECT_LT((rays.direction(150, 0) - Vec3(0, 1, 1).normalized()).norm(), 1e-15);
    EXPECT_LT((rays.direction(150, 200) - Vec3(0, 1, -1).normalized()).norm(), 1e-15);
    EXPECT_LT((rays.direction(300, 100) - Vec3(1.5, 1, 0).normalized()).norm(), 1e-15);
    EXPECT_LT((rays.direction(0, 0) - Vec3(-1.5, 1, 1).normalized()).norm(), 1e-15);
}

TEST(CameraRays, ProjectionTurnsDirectionsRound) {
    Camera camera = along_y(37);
    camera.target = Vec3(-2, 5, 1);
    camera.up = Vec3(0.2, -0.1, 0.9);
    const CameraRays rays(camera, 640, 480);
    for (const Vec2& at : {Vec2(0.5, 0.5), Vec2(639.5, 3.25), Vec2(17, 479)}) {
        const Vec3 point = rays.position() + 7.5 * rays.direction(at[0], at[1]);
        EXPECT_LT((rays.project(point) - at).norm(), 1e-9);
        EXPECT_NEAR(rays.in_camera(point).norm(), 7.5, 1e-12);
    }
}

TEST(CameraRays, AnImpossibleCameraIsAnInputError) {
    for (const double angle : {0.0, 180.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW(CameraRays(along_y(angle), 4, 3), InputError) << angle;
    Camera camera = along_y(50);
    camera.target = camera.position;
    EXPECT_THROW(CameraRays(camera, 4, 3), InputError);
    camera = along_y(50);
    camera.up = Vec3(0, -2, 0);
    EXPECT_THROW(CameraRays(camera, 4, 3), InputError);
    camera.up = Vec3::Zero();
    EXPECT_THROW(CameraRays(camera, 4, 3), InputError);
    camera.up = Vec3::Constant(std::numeric_limits<double>::infinity());
    EXPECT_THROW(CameraRays(camera, 4, 3), InputError);
}

}  // namespace
}  // namespace lightwell
