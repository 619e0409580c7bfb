#include "viewer/window/lit_scene.h"

#include <GL/glcorearb.h>
#include <gtest/gtest.h>

#include "tests/unit/propagation/coloured_room.h"
#include "viewer/images/tone.h"
#include "viewer/offscreen/gl_context.h"
#include "viewer/window/files.h"
#include "viewer/window/first_look.h"

namespace lightwell {
namespace {

class LitRoom : public ::testing::Test {
  protected:
    LitRoom() {
        camera_.position = {2.5, 0.4, 1.6};
        camera_.target = {1, 3, 1};
    }
    static std::vector<Light> lamp_at(double x) {
        return {PointLight{"lamp", {x, 1, 2}, Rgb::Constant(100)}};
    }

    std::unique_ptr<GlContext> context_ = make_offscreen_context();
    LitScene scene_{
        std::make_shared<const OpenedOperator>(opened(testing::coloured_room().transport)),
        context_->loader()};
    Camera camera_;
};

TEST_F(LitRoom, IsLitAnewOnlyWhenLampsChange) {
    EXPECT_TRUE(scene_.light(lamp_at(1), {}, false));
    EXPECT_GT(scene_.times().projection, 0);
    EXPECT_TRUE(scene_.is_at_rest());
    EXPECT_FALSE(scene_.light(lamp_at(1), {}, false));
    EXPECT_EQ(scene_.times().projection, 0);
    EXPECT_TRUE(scene_.light(lamp_at(1.5), {}, false));
}

TEST_F(LitRoom, WithABudgetItComesToTheExactLightWithinFrames) {
    UpdateOptions options;
    options.budget = 5;
    scene_.light(lamp_at(1), options, true);
    EXPECT_FALSE(scene_.is_at_rest());
    FrameView view;
    view.picture = Picture::difference;
    const auto unevenness = [&] {
        const Image image = image_of(scene_.linear(camera_, view, 64, 48));
        float most = 0;
        for (const Image::Pixel& pixel : image.pixels())
            most = std::max(most, pixel.maxCoeff() - pixel.minCoeff());
        return most;
    };
    EXPECT_GT(unevenness(), 0.05f);
    for (int frame = 0; frame < 12 && !scene_.is_at_rest(); ++frame)
        EXPECT_TRUE(scene_.light(lamp_at(1), options, true));
    EXPECT_TRUE(scene_.is_at_rest());
    EXPECT_LT(unevenness(), 1e-3f);
}

TEST_F(LitRoom, AFirstLookIsThePictureInDirectLight) {
    GlobalTransport nothing = first_look(testing::coloured_room().transport.scene);
    EXPECT_FALSE(is_computed(nothing));
    LitScene first(std::make_shared<const OpenedOperator>(opened(std::move(nothing))),
                   context_->loader());
    FrameView total, direct;
    direct.picture = Picture::direct;
    for (LitScene* scene : {&first, &scene_})
        scene->light(lamp_at(1), {}, false);
    EXPECT_EQ(first.linear(camera_, total, 64, 48).rgb, scene_.linear(camera_, direct, 64, 48).rgb);
}

TEST_F(LitRoom, KeepsWhatItDrew) {
    const GlFunctions gl(context_->loader());
    const GlObject colour = make_renderbuffer(gl, GL_RGBA8, 64, 48), target = make_framebuffer(gl);
    gl.bind_framebuffer(GL_FRAMEBUFFER, target.name());
    gl.framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                colour.name());
    const auto red = [&] {
        unsigned char rgba[4] = {0, 0, 0, 0};
        gl.read_pixels(32, 10, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
        return static_cast<int>(rgba[0]);
    };
    const float darkness[] = {0, 0, 0, 1};
    gl.clear_bufferfv(GL_COLOR, 0, darkness);
    scene_.show();
    EXPECT_EQ(red(), 0);
    scene_.light(lamp_at(1), {}, false);
    scene_.draw(camera_, {}, 64, 48);
    EXPECT_GT(scene_.times().drawing, 0);
    EXPECT_EQ(red(), 0);
    scene_.show();
    const int shown = red();
    EXPECT_GT(shown, 0);
    gl.clear_bufferfv(GL_COLOR, 0, darkness);
    scene_.show();
    EXPECT_EQ(red(), shown);
}

TEST_F(LitRoom, ExposureFitsThePictureToMiddleGrey) {
    scene_.light(lamp_at(1), {}, false);
    Visit visit{WalkCamera(camera_, Vec3::UnitZ())};
    expose(scene_, visit, 4.0 / 3);
    const Image seen = image_of(scene_.linear(visit.camera.camera(), visit.view, 120, 90));
    EXPECT_NEAR(visit.view.exposure, automatic_exposure(seen), 0.01);
    EXPECT_GT(visit.view.lux_maximum, 1);
}

TEST_F(LitRoom, IndirectLightAtAPointIsTheTexture) {
    scene_.light(lamp_at(1), {}, false);
    EXPECT_GT(luminance(scene_.indirect_at(4, true, {2, 1, 0})), 1);
    EXPECT_EQ(luminance(scene_.indirect_at(4, false, {2, 1, 0})), 0);
}

TEST(ShineAlike, ComparesAllButNames) {
    SpotLight spot;
    spot.intensity = Rgb::Ones();
    SpotLight named = spot;
    named.name = "other";
    EXPECT_TRUE(shine_alike({spot}, {named}));
    named.outer_angle += 1;
    EXPECT_FALSE(shine_alike({spot}, {named}));
    EXPECT_FALSE(shine_alike({spot}, {spot, spot}));
    EXPECT_FALSE(shine_alike({spot}, {PointLight{"", spot.position, spot.intensity}}));
}

}  // namespace
}  // namespace lightwell
