#include "runtime/frame.h"

#include <memory>

#include <gtest/gtest.h>

#include "radiance4d/scene/scene_quads.h"
#include "runtime/projection/shadow_projection.h"
#include "runtime/propagation/lighting.h"
#include "solver/precompute.h"
#include "tests/unit/frame/allocations.h"
#include "tests/unit/propagation/coloured_room.h"
#include "tests/unit/reference/rooms.h"

namespace lightwell {
namespace {

using testing::coloured_room;
using testing::light_path;

std::vector<Light> long_named_lamp_at(const Vec3& place) {
    return {PointLight{"a lamp with quite a long name", place, Rgb(100, 80, 60)}};
}

std::unique_ptr<LightProjection> projection() {
    return std::make_unique<ShadowProjection>(coloured_room().transport.space,
                                              coloured_room().quads, coloured_room().occluders);
}

TEST(Frame, ShowsWhatThePlainPipelineComputes) {
    Frame frame(coloured_room().transport, projection());
    for (const Vec3& place : light_path(1, 3)) {
        frame.light(long_named_lamp_at(place));
        const Lighting plain =
            light_scene(coloured_room().transport, long_named_lamp_at(place), coloured_room().quads,
                        coloured_room().occluders, Propagation::stored);
        const RadianceField indirect = unpacked(frame.indirect());
        EXPECT_LT((indirect - plain.indirect).matrix().norm(),
                  2e-3 * plain.indirect.matrix().norm());
        EXPECT_LT((unpacked(frame.direct()) - plain.direct).matrix().norm(),
                  3e-3 * plain.direct.matrix().norm());
    }
}

TEST(Frame, EmittingQuadsShineInEveryFrame) {
    GlobalTransport transport = coloured_room().transport;
    transport.scene.materials[static_cast<std::size_t>(transport.scene.quads[0].material)]
        .emission = Rgb(10, 20, 30);
    Frame frame(transport, projection());
    const Lighting plain = light_scene(transport, {}, coloured_room().quads,
                                       coloured_room().occluders, Propagation::stored);
    for (int k = 0; k < 2; ++k) {
        frame.light({});
        EXPECT_LT((unpacked(frame.direct()) - plain.direct).matrix().norm(),
                  1e-6 * plain.direct.matrix().norm());
        EXPECT_LT((unpacked(frame.indirect()) - plain.indirect).matrix().norm(),
                  1e-5 * plain.indirect.matrix().norm());
    }
}

TEST(Frame, AtRestNothingIsDone) {
    Frame frame(coloured_room().transport, projection());
    const std::vector<Light> lamp = long_named_lamp_at(Vec3(0.6, 0.7, 1.8));
    const FrameReport first = frame.light(lamp);
    EXPECT_TRUE(first.update.changed);
    EXPECT_EQ(first.textures, frame.textures().textures());
    const FrameReport second = frame.light(lamp);
    EXPECT_FALSE(second.update.changed);
    EXPECT_EQ(second.textures, 0U);
}

// Memory that grows to what is needed, when a lamp comes upon more shadows than ever before, is
// left out by going every way twice.
TEST(Frame, ASteadyFrameAllocatesNothing) {
    if (!testing::can_count_allocations()) GTEST_SKIP() << "allocations are not counted here";
    const testing::LightPath path = light_path(1, 60);
    std::vector<std::vector<Light>> lamps;
    for (const Vec3& place : path)
        lamps.push_back(long_named_lamp_at(place));
    for (const std::uint32_t budget : {0U, 30U}) {
        Frame frame(coloured_room().transport, projection());
        UpdateOptions options;
        options.budget = budget;
        std::uint64_t before = 0;
        for (int round = 0; round < 4; ++round) {
            before = testing::allocations();
            for (const std::vector<Light>& lamp : lamps)
                frame.light(lamp, options);
        }
        EXPECT_EQ(testing::allocations() - before, 0U) << "budget " << budget;
    }
}

TEST(Frame, NorDoesOneInWhichLampAndEyeMovePastAGlossyFloor) {
    if (!testing::can_count_allocations()) GTEST_SKIP() << "allocations are not counted here";
    const Rgb white = Rgb::Constant(0.6);
    Scene scene = box_scene(Vec3(2, 3, 2), {white, white, white, white, white, white});
    scene.materials[floor_z0].lobe = GgxLobe{Rgb::Constant(0.3), 0.4};
    PrecomputeOptions options;
    options.error = 0.3;
    options.cell_size = 0.5;
    options.most_attempts = 0;
    PrecomputeReport report;
    const GlobalTransport transport = precompute(scene, options, {}, report);
    const std::vector<Quad> quads = quads_of(scene);
    const OccluderTree occluders(quads);
    Frame frame(transport, std::make_unique<ShadowProjection>(transport.space, quads, occluders));
    ASSERT_TRUE(frame.is_glossy());
    std::vector<std::vector<Light>> lamps;
    for (int k = 0; k < 20; ++k)
        lamps.push_back(long_named_lamp_at(Vec3(0.3 + 0.05 * k, 0.5 + 0.1 * k, 1.7)));
    std::uint64_t before = 0;
    for (int round = 0; round < 4; ++round) {
        before = testing::allocations();
        for (std::size_t k = 0; k < lamps.size(); ++k) {
            frame.light(lamps[k]);
            EXPECT_EQ(frame.look(Vec3(1, 0.1 * static_cast<double>(k), 1)).lobes, 1u);
        }
    }
    EXPECT_EQ(testing::allocations() - before, 0U);
}

}  // namespace
}  // namespace lightwell
