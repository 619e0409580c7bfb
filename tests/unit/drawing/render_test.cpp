#include "viewer/offscreen/render.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "tests/unit/drawing/room_with_blocks.h"
#include "viewer/offscreen/gl_context.h"

namespace lightwell {
namespace {

class Render : public ::testing::Test {
  protected:
    std::unique_ptr<GlContext> context_ = make_offscreen_context();
    SurfaceDrawing room_{room_with_blocks(), context_->loader()};
};

Rgb by_position(int quad, bool front, const Vec3& position, const Vec3& to_eye) {
    return Rgb(position[0], position[1] * (front ? 1 : -1), 0.1 * quad + std::abs(to_eye[2]));
}

bool same(const Image& a, const Image& b) {
    if (a.width() != b.width() || a.height() != b.height()) return false;
    for (std::size_t k = 0; k < a.pixels().size(); ++k)
        if ((a.pixels()[k] != b.pixels()[k]).any()) return false;
    return true;
}

TEST_F(Render, PassesEveryPointToTheShade) {
    const Camera camera = camera_in_room();
    const Image image =
        render(room_, camera, {64, 48, 1, 1024},
               [&](int quad, bool front, const Vec3& position, const Vec3& to_eye) {
                   EXPECT_TRUE(front) << quad;
                   EXPECT_NEAR(to_eye.norm(), 1, 1e-12);
                   EXPECT_LT((camera.position - position).cross(to_eye).norm(), 1e-12);
                   EXPECT_GT((camera.position - position).dot(to_eye), 0);
                   return Rgb(position);
               });
    // The lower left of the picture is floor on the left: low x, z = 0; the upper right is at high
    // x.
    EXPECT_NEAR(image.at(11, 47)[2], 0, 1e-12);
    EXPECT_LT(image.at(11, 47)[0], 0.5f);
    EXPECT_GT(image.at(62, 10)[0], 2.9f);
    EXPECT_GT(image.at(32, 0)[2], 2);
}

TEST_F(Render, SamplesAreAveragedInLinearLight) {
    const auto shade = [](int quad, bool, const Vec3&, const Vec3&) {
        return Rgb::Constant(quad == 3 ? 8 : 0);
    };
    const Image fine = render(room_, camera_in_room(), {96, 72, 1, 1024}, shade);
    const Image coarse = render(room_, camera_in_room(), {32, 24, 3, 1024}, shade);
    int mixed = 0;
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 32; ++x) {
            float sum = 0;
            for (int k = 0; k < 9; ++k)
                sum += fine.at(3 * x + k % 3, 3 * y + k / 3)[0];
            EXPECT_FLOAT_EQ(coarse.at(x, y)[0], sum / 9);
            mixed += sum > 0 && sum < 72;
        }
    EXPECT_GT(mixed, 20);
}

TEST_F(Render, NeitherTilesNorThreadsLeaveATrace) {
    const Image whole = render(room_, camera_in_room(), {101, 67, 2, 4096}, by_position);
    EXPECT_TRUE(same(whole, render(room_, camera_in_room(), {101, 67, 2, 31}, by_position)));
    EXPECT_TRUE(same(whole, render(room_, camera_in_room(), {101, 67, 2, 1}, by_position)));
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_TRUE(same(whole, render(room_, camera_in_room(), {101, 67, 2, 4096}, by_position)));
}

TEST_F(Render, TheBackgroundIsBlack) {
    Camera camera;
    camera.position = Vec3(-1, -1, 1);
    camera.target = Vec3(-5, -5, 1);
    const Image image = render(room_, camera, {8, 6, 2, 1024},
                               [](int, bool, const Vec3&, const Vec3&) { return Rgb::Ones(); });
    for (const Image::Pixel& pixel : image.pixels())
        EXPECT_TRUE((pixel == 0.0f).all());
}

}  // namespace
}  // namespace lightwell
