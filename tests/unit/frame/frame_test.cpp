#include "runtime/frame.h"

#include <memory>

#include <gtest/gtest.h>

#include "runtime/projection/shadow_projection.h"
#include "runtime/propagation/lighting.h"
#include "tests/unit/frame/allocations.h"
#include "tests/unit/propagation/coloured_room.h"

namespace lightwell {
namespace {

using testing::coloured_room;
using testing::light_path;

std::vector<Light> lamp_at(const Vec3& place) {
    return {PointLight{"a lamp with quite a long name", place, Rgb(100, 80, 60)}};
}

std::unique_ptr<LightProjection> projection() {
    return std::make_unique<ShadowProjection>(coloured_room().transport.space,
                                              coloured_room().quads, coloured_room().occluders);
}

TEST(Frame, ShowsWhatThePlainPipelineComputes) {
    Frame frame(coloured_room().transport, projection());
    for (const Vec3& place : light_path(1, 3)) {
        frame.light(lamp_at(place));
        const Lighting plain =
            light_scene(coloured_room().transport, lamp_at(place), coloured_room().quads,
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
    const std::vector<Light> lamp = lamp_at(Vec3(0.6, 0.7, 1.8));
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
        lamps.push_back(lamp_at(place));
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

}  // namespace
}  // namespace lightwell
