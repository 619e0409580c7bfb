#include "runtime/drawing/frame_renderer.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "radiance4d/scene/direct_light.h"
#include "radiance4d/scene/visibility.h"
#include "runtime/drawing/camera_rays.h"
#include "tests/unit/drawing/room_with_blocks.h"
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

}  // namespace
}  // namespace lightwell
