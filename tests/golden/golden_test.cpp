// Every way to show a frame, against pictures that were looked at once. A picture that differs
// leaves its result, the reference and the difference, eight times amplified, in a folder that the
// failure names. With LIGHTWELL_UPDATE_GOLDEN set the references are written anew, to be looked at.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>

#include <gtest/gtest.h>

#include "radiance4d/scene/scene_quads.h"
#include "runtime/frame.h"
#include "runtime/projection/shadow_projection.h"
#include "solver/precompute.h"
#include "tests/golden/byte_picture.h"
#include "tests/unit/drawing/drawn_bytes.h"
#include "tests/unit/reference/rooms.h"
#include "viewer/offscreen/gl_context.h"

namespace lightwell {
namespace {

using testing::BytePicture;

/// A coloured room with a block, a panel that shines from the ceiling, a point and a spot.
struct GoldenRoom {
    GlobalTransport transport;
    std::vector<Quad> quads;
    OccluderTree occluders;
    std::vector<Light> lamps;
    Camera camera;
};

Scene golden_scene() {
    const Rgb white(0.7, 0.7, 0.7), red(0.6, 0.1, 0.1), green(0.1, 0.5, 0.15);
    Scene scene = box_scene(Vec3(3, 4, 2.5), {red, green, white, white, white, white});
    add_block(scene, Vec3(1, 1.5, 0), Vec3(1.8, 2.3, 1.2), white);
    add_quad(scene,
             Quad{{Vec3(1, 2.6, 2.4), Vec3(1, 3.4, 2.4), Vec3(2, 3.4, 2.4), Vec3(2, 2.6, 2.4)}},
             white)
        .emission = Rgb(60, 60, 50);
    return scene;
}

/// The same with a floor that shines.
Scene polished_scene() {
    Scene scene = golden_scene();
    Material polished;
    polished.reflectance = Rgb::Constant(0.1);
    polished.lobe = GgxLobe{Rgb::Constant(0.7), 0.3};
    for (SceneQuad& quad : scene.quads)
        if (quad.quad.normal()[2] > 0.9 && quad.quad.centre()[2] < 0.01)
            quad.material = static_cast<int>(scene.materials.size());
    scene.materials.push_back(polished);
    return scene;
}

const GoldenRoom& golden_room(bool is_polished) {
    const auto made = [](const Scene& scene, double error, double cell_size) {
        PrecomputeOptions options;
        options.error = error;
        options.cell_size = cell_size;
        options.most_attempts = 0;
        PrecomputeReport report;
        GlobalTransport transport = precompute(scene, options, {}, report);
        std::vector<Quad> quads = quads_of(transport.scene);
        OccluderTree occluders(quads);
        SpotLight spot;
        spot.name = "spot";
        spot.position = Vec3(0.4, 0.6, 2.2);
        spot.direction = Vec3(0.5, 2, -1.6).normalized();
        spot.intensity = Rgb(40, 36, 30);
        Camera camera;
        camera.position = Vec3(2.4, 0.1, 1.7);
        camera.target = Vec3(1.3, 3, 0.9);
        camera.vertical_angle = 75;
        return GoldenRoom{std::move(transport),
                          std::move(quads),
                          std::move(occluders),
                          {PointLight{"point", Vec3(2.5, 1.2, 1.5), Rgb(10, 12, 20)}, spot},
                          camera};
    };
    if (is_polished) {
        static const GoldenRoom polished = made(polished_scene(), 0.3, 0.5);
        return polished;
    }
    static const GoldenRoom diffuse = made(golden_scene(), 0.1, 0.25);
    return diffuse;
}

struct GoldenView {
    const char* name = "";
    FrameView view;
    double rms = 2.5;       ///< largest allowed
    double far_off = 0.01;  ///< largest allowed
    bool is_polished = false;
};

std::ostream& operator<<(std::ostream& out, const GoldenView& golden) {
    return out << golden.name;
}

GoldenView golden_view(const char* name, Picture picture,
                       const std::function<void(FrameView&)>& change = {}) {
    GoldenView golden;
    golden.name = name;
    golden.view.picture = picture;
    golden.view.exposure = -4;
    golden.view.lux_maximum = 60;
    golden.view.lux_divisions = 6;
    if (change) change(golden.view);
    if (picture == Picture::lux && golden.view.contours) {
        // A line may be drawn one pixel aside; without its lines the picture is 20 steps off.
        golden.rms = 6;
        golden.far_off = 0.03;
    }
    return golden;
}

std::vector<GoldenView> golden_views() {
    const auto polished = [](const char* name, Picture picture) {
        GoldenView golden = golden_view(name, picture);
        golden.is_polished = true;
        return golden;
    };
    return {
        polished("polished", Picture::total),
        polished("polished_indirect", Picture::indirect),
        golden_view("total", Picture::total),
        golden_view("direct", Picture::direct),
        golden_view("indirect", Picture::indirect),
        golden_view("lux", Picture::lux),
        golden_view("lux_plain", Picture::lux, [](FrameView& view) { view.contours = false; }),
        golden_view("level", Picture::level),
        golden_view("coefficients", Picture::coefficients),
        golden_view("difference", Picture::difference,
                    [](FrameView& view) { view.difference_range = 0.5; }),
        golden_view("texels", Picture::total, [](FrameView& view) { view.bilinear = false; }),
        golden_view("clipped", Picture::total, [](FrameView& view) { view.tone_curve = false; }),
        golden_view("samples", Picture::total, [](FrameView& view) { view.samples = 2; }),
        golden_view("coarse", Picture::total, [](FrameView& view) { view.coarseness = 3; })};
}

BytePicture drawn(const GoldenView& golden) {
    const FrameView& view = golden.view;
    const GoldenRoom& room = golden_room(golden.is_polished);
    const std::unique_ptr<GlContext> context = make_offscreen_context();
    const auto new_frame = [&] {
        return std::make_unique<Frame>(
            room.transport,
            std::make_unique<ShadowProjection>(room.transport.space, room.quads, room.occluders));
    };
    const auto exact = new_frame();
    exact->light(room.lamps);
    FrameRenderer renderer(room.transport, context->loader());
    renderer.set_lights(room.lamps);
    renderer.upload_exact(exact->textures());
    renderer.upload(exact->textures());
    if (exact->look(room.camera.position).lobes > 0)
        renderer.upload_lobes(exact->lobes(), exact->emitted_lobes());
    if (view.picture == Picture::difference) {
        // The first frame of an update that may multiply few coefficients.
        const auto rough = new_frame();
        UpdateOptions options;
        options.budget = 8;
        rough->light(room.lamps, options);
        renderer.upload(rough->textures());
    }
    return testing::drawn_bytes(renderer, context->loader(), room.camera, view, 128, 96);
}

/// How far apart two pictures are, in 8-bit steps.
struct Distance {
    double rms = 0;
    double far_off = 0;  ///< share of pixels with a channel more than 24 steps off
    BytePicture difference;
};

Distance distance(const BytePicture& a, const BytePicture& b) {
    Distance result;
    result.difference = a;
    double squares = 0, far_off = 0;
    for (std::size_t k = 0; k < a.rgb.size(); k += 3) {
        int largest = 0;
        for (std::size_t c = k; c < k + 3; ++c) {
            const int off = std::abs(static_cast<int>(a.rgb[c]) - static_cast<int>(b.rgb[c]));
            squares += off * off;
            largest = std::max(largest, off);
            result.difference.rgb[c] = static_cast<std::uint8_t>(std::min(255, 8 * off));
        }
        if (largest > 24) ++far_off;
    }
    result.rms = std::sqrt(squares / static_cast<double>(a.rgb.size()));
    result.far_off = far_off / (static_cast<double>(a.rgb.size()) / 3);
    return result;
}

class Golden : public ::testing::TestWithParam<GoldenView> {};

TEST_P(Golden, IsAsItWasWhenLookedAt) {
    const std::string name = GetParam().name;
    const std::string file = LIGHTWELL_GOLDEN "/" + name + ".png";
    const BytePicture result = drawn(GetParam());
    if (std::getenv("LIGHTWELL_UPDATE_GOLDEN")) {
        testing::write_png(result, file);
        GTEST_SKIP() << file << " is written anew: look at it";
    }
    const BytePicture reference = testing::read_png(file);
    ASSERT_EQ(reference.rgb.size(), result.rgb.size()) << file;
    ASSERT_EQ(reference.width, result.width);
    const Distance apart = distance(result, reference);
    // The operator may be computed a little differently tomorrow, and other drivers round edges in
    // their own way; a view that is broken is tens of steps off.
    EXPECT_LT(apart.rms, GetParam().rms);
    EXPECT_LT(apart.far_off, GetParam().far_off);
    if (!HasFailure()) return;
    const std::string folder = LIGHTWELL_GOLDEN_RESULTS;
    std::filesystem::create_directories(folder);
    testing::write_png(result, folder + "/" + name + "-result.png");
    testing::write_png(reference, folder + "/" + name + "-reference.png");
    testing::write_png(apart.difference, folder + "/" + name + "-difference.png");
    ADD_FAILURE() << "see " << folder << "/" << name << "-{result,reference,difference}.png";
}

INSTANTIATE_TEST_SUITE_P(Views, Golden, ::testing::ValuesIn(golden_views()),
                         [](const auto& view) { return std::string(view.param.name); });

}  // namespace
}  // namespace lightwell
