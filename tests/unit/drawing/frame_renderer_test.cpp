#include "runtime/drawing/frame_renderer.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "radiance4d/basis/angular_reflection.h"
#include "radiance4d/scene/brdf.h"
#include "radiance4d/scene/direct_light.h"
#include "radiance4d/scene/visibility.h"
#include "runtime/drawing/camera_rays.h"
#include "tests/unit/drawing/drawn_bytes.h"
#include "tests/unit/drawing/room_with_blocks.h"
#include "viewer/images/false_colour.h"
#include "viewer/images/tone.h"
#include "viewer/offscreen/gl_context.h"

namespace lightwell {
namespace {

/// The room with blocks, larger or smaller and somewhere else, with a camera and lamps in it. Its
/// ceiling holds an emitting quad that hangs a little below it.
struct TestRoom {
    GlobalTransport transport;
    std::vector<Quad> quads;
    Camera camera = camera_in_room();
    std::vector<Light> lamps;

    explicit TestRoom(double scale = 1, const Vec3& shift = Vec3::Zero(), bool emits = false) {
        const auto placed = [&](const Vec3& point) { return Vec3(scale * point + shift); };
        quads = room_with_blocks();
        if (emits)
            quads.push_back(
                Quad{{Vec3(1, 1, 2.3), Vec3(1, 2, 2.3), Vec3(1.8, 2, 2.3), Vec3(1.8, 1, 2.3)}});
        for (Quad& quad : quads) {
            for (Vec3& vertex : quad.vertex)
                vertex = placed(vertex);
            transport.scene.quads.push_back({quad, 0, 0, 0});
        }
        Material wall;
        wall.reflectance = Rgb(0.6, 0.5, 0.4);
        transport.scene.materials = {wall};
        if (emits) {
            Material panel;
            panel.emission = Rgb(300, 200, 100);
            transport.scene.materials.push_back(panel);
            transport.scene.quads.back().material = 1;
        }
        camera.position = placed(camera.position);
        camera.target = placed(camera.target);
        const double square = scale * scale;
        PointLight point{"point", placed(Vec3(2.2, 3.1, 2.0)), square * Rgb(30, 60, 90)};
        SpotLight spot;
        spot.position = placed(Vec3(0.4, 0.5, 2.2));
        spot.intensity = square * Rgb(200, 100, 50);
        spot.direction = Vec3(0.5, 2, -1.2).normalized();
        lamps = {point, spot};
    }
};

/// How illuminance in a picture differs from the exact one at the pixels' centres, relative to that
/// and a hundredth of the picture's mean.
struct Agreement {
    int pixels = 0;
    double median = 0;   ///< of the relative error
    double far_off = 0;  ///< share of pixels that are more than 1 % off
    double mean = 0;     ///< mean error over mean illuminance
};

Agreement compare(const LinearPicture& drawn, const TestRoom& room,
                  const std::vector<Light>& lamps) {
    const Visibility visibility(room.quads);
    const OccluderTree occluders(room.quads);
    const DirectLight exact(room.transport.scene, visibility, occluders);
    const CameraRays rays(room.camera, drawn.width, drawn.height);
    std::vector<double> right, error;
    for (int y = 0; y < drawn.height; ++y)
        for (int x = 0; x < drawn.width; ++x) {
            const Vec3 direction = rays.direction(x + 0.5, y + 0.5);
            const Hit hit = visibility.nearest(rays.position(), free_point, direction);
            if (hit.quad < 0) continue;
            const Quad& quad = room.quads[static_cast<std::size_t>(hit.quad)];
            const Vec3 normal = quad.normal();
            const double t = normal.dot(quad.vertex[0] - rays.position()) / normal.dot(direction);
            const Vec3 point = rays.position() + t * direction;
            right.push_back(
                exact.irradiance(point, hit.front ? normal : Vec3(-normal), hit.quad, lamps)[0]);
            const auto at = static_cast<std::size_t>(3 * (y * drawn.width + x));
            error.push_back(static_cast<double>(drawn.rgb[at]) - right.back());
        }
    Agreement agreement;
    agreement.pixels = static_cast<int>(right.size());
    double sum = 0, off = 0;
    for (std::size_t k = 0; k < right.size(); ++k) {
        sum += right[k];
        off += std::abs(error[k]);
    }
    agreement.mean = off / sum;
    const double floor = 0.01 * sum / agreement.pixels;
    std::vector<double> relative;
    for (std::size_t k = 0; k < right.size(); ++k)
        relative.push_back(std::abs(error[k]) / (right[k] + floor));
    agreement.far_off = static_cast<double>(std::count_if(relative.begin(), relative.end(),
                                                          [](double r) { return !(r < 0.01); })) /
                        agreement.pixels;
    std::nth_element(relative.begin(), relative.begin() + agreement.pixels / 2, relative.end());
    agreement.median = relative[static_cast<std::size_t>(agreement.pixels / 2)];
    return agreement;
}

class FrameRendererTest : public ::testing::Test {
  protected:
    LinearPicture lux(const TestRoom& room, const std::vector<Light>& lamps, int width = 160,
                      int height = 120) {
        FrameRenderer renderer(room.transport, context_->loader());
        renderer.set_lights(lamps);
        FrameView view;
        view.picture = Picture::lux;
        return renderer.linear(room.camera, view, width, height);
    }

    std::unique_ptr<GlContext> context_ = make_offscreen_context();
};

// Lamps are exact but for a pixel along the edges of shadows: at any scale, anywhere.
TEST_F(FrameRendererTest, LampsAgreeWithExactLightAtAnyScale) {
    for (const double scale : {1e-3, 1.0, 1e3}) {
        const TestRoom room(scale, scale * Vec3(20, -7, 3));
        const Agreement agreement = compare(lux(room, room.lamps), room, room.lamps);
        EXPECT_EQ(agreement.pixels, 160 * 120);
        EXPECT_LT(agreement.median, 2e-6) << scale;
        EXPECT_LT(agreement.far_off, 0.02) << scale;
        EXPECT_LT(agreement.mean, 0.005) << scale;
    }
}

// Most of them see all of the emitter; in penumbras the share that is hidden is estimated.
TEST_F(FrameRendererTest, EmittingQuadsAgreeWithExactLight) {
    const TestRoom room(1, Vec3(20, -7, 3), true);
    const Agreement agreement = compare(lux(room, {}), room, {});
    EXPECT_EQ(agreement.pixels, 160 * 120);
    EXPECT_LT(agreement.median, 2e-5);
    EXPECT_LT(agreement.far_off, 0.1);
    EXPECT_LT(agreement.mean, 0.003);
}

Image image_of(const LinearPicture& picture) {
    Image image(picture.width, picture.height);
    for (std::size_t p = 0; p < image.pixels().size(); ++p)
        image.pixels()[p] = Eigen::Map<const Image::Pixel>(picture.rgb.data() + 3 * p);
    return image;
}

/// Whether every channel of a drawn frame is, to one step, what `image`, the light of a display,
/// comes to.
void expect_shown(const testing::BytePicture& drawn, const Image& image) {
    int off = 0;
    for (std::size_t k = 0; k < drawn.rgb.size(); ++k) {
        const double linear = static_cast<double>(image.pixels()[k / 3][static_cast<int>(k % 3)]);
        off += std::abs(drawn.rgb[k] - 255 * srgb_encoded(linear)) > 1.0;
    }
    EXPECT_EQ(off, 0);
}

class ShownFrame : public FrameRendererTest {
  protected:
    ShownFrame() { renderer_.set_lights(room_.lamps); }
    testing::BytePicture shown(const FrameView& view) {
        return testing::drawn_bytes(renderer_, context_->loader(), room_.camera, view, 64, 48);
    }
    Image linear(const FrameView& view) {
        return image_of(renderer_.linear(room_.camera, view, 64, 48));
    }

    TestRoom room_;
    FrameRenderer renderer_{room_.transport, context_->loader()};
};

// The shaders' tone curve, sRGB and false colours are those of the pictures that are written.
TEST_F(ShownFrame, IsDevelopedAsPicturesAre) {
    FrameView view;
    view.exposure = -3;
    for (const bool curve : {true, false}) {
        view.tone_curve = curve;
        for (const int samples : {1, 2}) {
            view.samples = samples;
            expect_shown(shown(view),
                         develop(linear(view), {-3, curve ? ToneCurve::filmic : ToneCurve::clip}));
        }
    }
}

TEST_F(ShownFrame, HasTheFalseColoursOfPictures) {
    FrameView view;
    view.picture = Picture::lux;
    view.lux_maximum = 150;
    view.lux_divisions = 5;
    FalseColour style;
    style.maximum = view.lux_maximum;
    style.divisions = view.lux_divisions;
    style.legend = false;
    for (const bool contours : {false, true}) {
        view.contours = style.contours = contours;
        expect_shown(shown(view), false_coloured(linear(view), style));
    }
}

TEST_F(ShownFrame, IsTheSameInParts) {
    renderer_.set_lights(room_.lamps);
    FrameView view;
    view.picture = Picture::lux;
    view.lux_maximum = 60;
    view.samples = 2;
    const auto drawn = [&](const std::vector<PictureRows>& parts) {
        return testing::drawn_bytes(renderer_, context_->loader(), room_.camera, view, 64, 48,
                                    parts)
            .rgb;
    };
    const auto whole = drawn({{}});
    // In between the images behind it were another picture's.
    view.samples = 1;
    drawn({{}});
    view.samples = 2;
    EXPECT_EQ(drawn({{0, 0.3}, {0.3, 0.305}, {0.305, 0.9}, {0.9, 1}}), whole);
    // What is not drawn stays as it is.
    EXPECT_NE(drawn({{0, 0.5}, {0.75, 1}}), whole);
}

// Others draw with the context, too.
TEST_F(ShownFrame, LeavesTheFramebufferThatItFound) {
    const GlFunctions gl(context_->loader());
    const GlObject framebuffer = make_framebuffer(gl);
    gl.bind_framebuffer(GL_FRAMEBUFFER, framebuffer.name());
    renderer_.set_lights({PointLight{"other", Vec3(1, 1, 1), Rgb::Ones()}});
    linear({});
    for (const unsigned binding : {GL_DRAW_FRAMEBUFFER_BINDING, GL_READ_FRAMEBUFFER_BINDING}) {
        int bound = 0;
        gl.get_integerv(binding, &bound);
        EXPECT_EQ(static_cast<unsigned>(bound), framebuffer.name());
    }
    gl.bind_framebuffer(GL_FRAMEBUFFER, 0);
}

// A lamp a millimetre off a wall, and one on the other side of it: neither leaks nor acne.
TEST_F(FrameRendererTest, LampsCloseToWallsLightWhatTheyShould) {
    const TestRoom room;
    const std::vector<Light> close = {PointLight{"close", Vec3(0.001, 2.0, 1.2), Rgb::Ones()}};
    EXPECT_LT(compare(lux(room, close), room, close).mean, 0.01);
    const std::vector<Light> outside = {PointLight{"out", Vec3(-0.001, 2.0, 1.2), Rgb::Ones()}};
    const LinearPicture dark = lux(room, outside);
    EXPECT_EQ(*std::max_element(dark.rgb.begin(), dark.rgb.end()), 0);
}

TEST_F(FrameRendererTest, ManyLampsAddUp) {
    const TestRoom room;
    std::vector<Light> lamps;
    std::vector<float> sum(3 * 32 * 24, 0);
    for (int k = 0; k < 9; ++k) {
        lamps.push_back(
            PointLight{"lamp", Vec3(0.3 + 0.27 * k, 0.5 + 0.3 * k, 2.2), Rgb::Constant(10 + k)});
        const LinearPicture alone = lux(room, {lamps.back()}, 32, 24);
        for (std::size_t p = 0; p < sum.size(); ++p)
            sum[p] += alone.rgb[p];
    }
    const LinearPicture all = lux(room, lamps, 32, 24);
    for (std::size_t p = 0; p < sum.size(); ++p)
        EXPECT_NEAR(all.rgb[p], sum[p], 1e-4f * (1 + sum[p]));
}

/// A glossy floor under a lamp, drawn, against the BRDF times the illuminance at every pixel.
// So many that their maps must be smaller to find room.
TEST_F(FrameRendererTest, HundredsOfLampsFindRoom) {
    const TestRoom room;
    PointLight lamp = std::get<PointLight>(room.lamps[0]);
    const LinearPicture one = lux(room, {lamp}, 16, 12);
    constexpr int count = 500;
    lamp.intensity /= count;
    const LinearPicture many = lux(room, std::vector<Light>(count, lamp), 16, 12);
    for (std::size_t k = 0; k < one.rgb.size(); ++k)
        EXPECT_NEAR(many.rgb[k], one.rgb[k], 0.02F * one.rgb[k] + 0.1F) << k;
}

TEST_F(FrameRendererTest, AfterManyLampsAFewAreDrawnAsFinelyAsEver) {
    const TestRoom room;
    FrameRenderer renderer(room.transport, context_->loader());
    renderer.set_lights(std::vector<Light>(100, room.lamps[0]));
    renderer.set_lights(room.lamps);
    FrameView view;
    view.picture = Picture::lux;
    EXPECT_EQ(renderer.linear(room.camera, view, 64, 48).rgb, lux(room, room.lamps, 64, 48).rgb);
}

TEST_F(FrameRendererTest, HighlightsOfLampsAreExactForEveryLobe) {
    const Lobe lobes[] = {PhongLobe{Rgb(0.5, 0.4, 0.3), 200}, GgxLobe{Rgb(0.5, 0.4, 0.3), 0.15}};
    for (const Lobe& lobe : lobes) {
        GlobalTransport transport;
        Material glossy;
        glossy.reflectance = Rgb(0.1, 0.1, 0.2);
        glossy.lobe = lobe;
        transport.scene.materials = {glossy};
        const Quad floor{{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 2, 0), Vec3(0, 2, 0)}};
        transport.scene.quads = {{floor, 0, 0, 0}};
        Element element;
        element.geometry = floor;
        element.space = HaarBasis(floor, CellTree({Split::both}));
        element.angle = angular_basis(2).tree();
        transport.space = RadianceSpace({element});
        PointLight lamp;
        lamp.position = Vec3(1, 1.6, 0.8);
        lamp.intensity = Rgb(10, 20, 30);
        Camera camera;
        camera.position = Vec3(1, -1.2, 1.5);
        camera.target = Vec3(1, 1, 0);
        FrameRenderer renderer(transport, context_->loader());
        renderer.set_lights({lamp});
        const LinearPicture drawn = renderer.linear(camera, {}, 80, 60);
        const CameraRays rays(camera, 80, 60);
        double brightest = 0, dimmest = 1e9;
        for (int y = 5; y < 55; ++y)
            for (int x = 5; x < 75; ++x) {
                const Vec3 eye = rays.position(), ray = rays.direction(x + 0.5, y + 0.5);
                const Vec3 point = eye - eye[2] / ray[2] * ray;
                constexpr double rim = 0.05;  // less than half a pixel of the picture
                if (!(ray[2] < 0) || point[0] < rim || point[0] > 2 - rim || point[1] < rim ||
                    point[1] > 2 - rim)
                    continue;
                const Vec3 way = lamp.position - point, in = way.normalized();
                const Vec3 out = (camera.position - point).normalized();
                const Rgb exact =
                    brdf(glossy, in, out) * lamp.intensity * in[2] / way.squaredNorm();
                for (int c = 0; c < 3; ++c) {
                    const double shown =
                        static_cast<double>(drawn.rgb[3 * static_cast<std::size_t>(80 * y + x) +
                                                      static_cast<std::size_t>(c)]);
                    EXPECT_NEAR(shown, exact[c], 2e-3 * exact[c]) << x << " " << y;
                }
                brightest = std::max(brightest, exact[0]);
                dimmest = std::min(dimmest, exact[0]);
            }
        EXPECT_GT(brightest, 20 * dimmest);
    }
}

}  // namespace
}  // namespace lightwell
