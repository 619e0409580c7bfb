#include "radiance4d/scene/keyframes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

CameraKey camera_key(double time, double x) {
    CameraKey key{time, {}};
    key.camera.position = Vec3(x, 0, 0);
    key.camera.target = Vec3(x, 1, 0);
    return key;
}

LightKey lamp_key(double time, const Vec3& position, double intensity) {
    return {time, PointLight{"lamp", position, Rgb::Constant(intensity)}};
}

TEST(Keyframes, TwoKeysAreJoinedByAStraightLine) {
    Keyframes keyframes;
    keyframes.camera = {camera_key(1, 0), camera_key(3, 4)};
    for (const double time : {1.0, 1.3, 2.0, 2.9, 3.0})
        EXPECT_NEAR(keyframes.camera_at(time).position[0], 2 * (time - 1), 1e-12) << time;
    EXPECT_EQ(keyframes.camera_at(0).position[0], 0);
    EXPECT_EQ(keyframes.camera_at(9).position[0], 4);
}

// Every key is met, the slope is continuous there, and nothing leaves the range of its two keys.
TEST(Keyframes, SeveralKeysAreJoinedSmoothlyAndWithoutOvershoot) {
    const double times[] = {0, 1, 1.5, 4, 5}, places[] = {0, 3, 3, 10, 9};
    Keyframes keyframes;
    for (int k = 0; k < 5; ++k)
        keyframes.camera.push_back(camera_key(times[k], places[k]));
    const auto place = [&](double time) { return keyframes.camera_at(time).position[0]; };
    constexpr double step = 1e-5;
    for (int k = 0; k < 5; ++k)
        EXPECT_NEAR(place(times[k]), places[k], 1e-12);
    for (int k = 1; k < 4; ++k)
        EXPECT_NEAR((place(times[k]) - place(times[k] - step)) / step,
                    (place(times[k] + step) - place(times[k])) / step, 1e-3)
            << k;
    for (int k = 0; k < 4; ++k)
        for (double t = times[k]; t < times[k + 1]; t += 0.01) {
            EXPECT_GE(place(t), std::min(places[k], places[k + 1]) - 1e-12) << t;
            EXPECT_LE(place(t), std::max(places[k], places[k + 1]) + 1e-12) << t;
        }
}

TEST(Keyframes, MovingLightsTakeThePlaceOfThoseOfTheSameName) {
    Keyframes keyframes;
    keyframes.lights = {{lamp_key(0, Vec3(0, 0, 1), 100), lamp_key(2, Vec3(2, 0, 1), 0)}};
    const std::vector<Light> others = {PointLight{"other", Vec3(5, 5, 5), Rgb::Constant(7)},
                                       PointLight{"lamp", Vec3(9, 9, 9), Rgb::Constant(9)}};
    const std::vector<Light> lights = keyframes.lights_at(1, others);
    ASSERT_EQ(lights.size(), 2U);
    EXPECT_EQ(position_of(lights[0]), Vec3(5, 5, 5));
    EXPECT_NEAR((position_of(lights[1]) - Vec3(1, 0, 1)).norm(), 0, 1e-12);
    EXPECT_NEAR(std::get<PointLight>(lights[1]).intensity[0], 50, 1e-12);
    EXPECT_EQ(keyframes.lights_at(1, {}).size(), 1U);
}

TEST(Keyframes, SpotsTurnAndOpen) {
    SpotLight low, high;
    low.direction = Vec3::UnitX();
    high.direction = Vec3::UnitY();
    low.inner_angle = 10;
    high.inner_angle = 20;
    high.outer_angle = 50;
    Keyframes keyframes;
    keyframes.lights = {{{0, low}, {1, high}}};
    const auto spot = std::get<SpotLight>(keyframes.lights_at(0.5, {})[0]);
    EXPECT_NEAR((spot.direction - Vec3(1, 1, 0).normalized()).norm(), 0, 1e-12);
    EXPECT_NEAR(spot.inner_angle, 15, 1e-12);
    EXPECT_NEAR(spot.outer_angle, 40, 1e-12);
}

TEST(Keyframes, PicturesRunFromTheFirstKeyOfAllToTheLast) {
    Keyframes keyframes;
    keyframes.frames_per_second = 10;
    keyframes.camera = {camera_key(1, 0), camera_key(2.3, 4)};
    keyframes.lights = {{lamp_key(0.5, Vec3::Zero(), 1)}};
    EXPECT_EQ(keyframes.frames(), 19);
    EXPECT_NEAR(keyframes.time_of(18), 2.3, 1e-12);
    EXPECT_EQ(Keyframes().frames(), 1);
}

}  // namespace
}  // namespace lightwell
