#include "solver/reference/verification.h"

#include <cmath>

#include <gtest/gtest.h>

#include "radiance4d/operator/light_projection.h"
#include "solver/precompute.h"
#include "solver/reference/error_estimate.h"
#include "solver/reference/path_tracer.h"
#include "solver/reference/random_stream.h"
#include "tests/unit/reference/rooms.h"

namespace lightwell {
namespace {

/// A room of three kinds of walls with a coarse operator.
struct CoarseRoom {
    CoarseRoom() {
        PrecomputeOptions coarse;
        coarse.error = 0.1;
        coarse.cell_size = 0.5;
        coarse.most_attempts = 0;
        PrecomputeReport report;
        transport = precompute(scene, coarse, {}, report);
    }

    /// As the basis shows it, and by the stored operator alone.
    ShownLight picture() const { return smooth("picture", gathered_light); }
    ShownLight textures() const {
        return smooth("textures", [](const GlobalTransport& of, const RadianceField& direct) {
            return RadianceField(global_light(of, direct) - direct);
        });
    }

    Verification verified(const std::vector<ShownLight>& ways, const VerifyOptions& options) const {
        return verify(scene, transport.space, visibility, occluders, ways, options, {});
    }

    using Propagate = std::function<RadianceField(const GlobalTransport&, const RadianceField&)>;
    ShownLight smooth(const std::string& name, const Propagate& indirect) const {
        return {name, [=](const PointLight& lamp, const std::vector<SurfacePoint>& points) {
                    const RadianceField direct =
                        projected_lights(transport.space, {lamp}, quads, occluders);
                    return shown_at(points, transport.space,
                                    smooth_irradiance(transport.space, indirect(transport, direct)),
                                    quads);
                }};
    }

    Scene scene =
        box_scene({3, 2, 2}, {Rgb::Constant(0.2), Rgb::Constant(0.3), Rgb::Constant(0.1),
                              Rgb(0.4, 0.3, 0.1), Rgb::Constant(0.3), Rgb::Constant(0.2)});
    std::vector<Quad> quads = [this] {
        std::vector<Quad> all;
        for (const SceneQuad& one : scene.quads)
            all.push_back(one.quad);
        return all;
    }();
    Visibility visibility{quads};
    OccluderTree occluders{quads};
    GlobalTransport transport;
};

const CoarseRoom& room() {
    static const CoarseRoom one;
    return one;
}

bool contains(const Interval& interval, double value) {
    return interval.low <= value && value <= interval.high;
}

/// Whether an interval of twice the width does, which one in ten thousand does not: a repetition
/// that was fixed once is one of the twenty that miss otherwise, after some change or other.
bool nearly_contains(const Interval& interval, double value) {
    return contains(
        {interval.value, 2 * interval.low - interval.value, 2 * interval.high - interval.value},
        value);
}

// Whoever shows nothing is wrong by all there is, whatever the scene.
TEST(Verification, FindsTheErrorOfShowingNothing) {
    const ShownLight darkness{"darkness",
                              [](const PointLight&, const std::vector<SurfacePoint>& points) {
                                  return std::vector<Rgb>(points.size(), Rgb::Zero());
                              }};
    VerifyOptions options;
    options.noise = 0.1;
    const Verification found =
        room().verified({room().picture(), darkness, room().textures()}, options);
    ASSERT_EQ(found.shown.size(), 3U);
    const ErrorSize& indirect = found.shown[1].indirect;
    EXPECT_TRUE(nearly_contains(indirect.relative_l2, 1))
        << indirect.relative_l2.low << " to " << indirect.relative_l2.high;
    EXPECT_LT(indirect.relative_l2.high - indirect.relative_l2.low, 0.1);
    EXPECT_TRUE(nearly_contains(indirect.bias, -1));
    EXPECT_LT(indirect.bias.high - indirect.bias.low, 0.1);
    for (const double share : indirect.relative)
        EXPECT_NEAR(share, 1, 0.02);
    EXPECT_EQ(found.shown[1].worst.shown, 0);
    EXPECT_GT(found.shown[1].worst.judged, indirect.lux[2]);
    // With the light that comes straight from the lamp, the same error is relatively small.
    const ErrorSize& total = found.shown[1].total;
    EXPECT_LT(total.relative_l2.value, 0.5);
    EXPECT_LT(total.bias.value, 0);
    EXPECT_GT(total.bias.value, -0.5);
    EXPECT_NEAR(total.lux[1], indirect.lux[1], 1e-3 * indirect.lux[1]);
}

// Light that is right but for a factor: 1.1 at some lamps and 0.95 at the others.
TEST(Verification, FindsAnErrorOfKnownSize) {
    const CoarseRoom& r = room();
    const ShownLight tinted{
        "tinted", [&r](const PointLight& lamp, const std::vector<SurfacePoint>& points) {
            PathTracing fine;
            fine.samples = 1024;
            fine.seed = 99;
            std::vector<Rgb> values;
            for (const LightEstimate& one :
                 PathTracer(r.scene, r.visibility, {lamp}).indirect(points, fine).at)
                values.push_back((lamp.position[0] < 1.5 ? 1.1 : 0.95) * one.mean);
            return values;
        }};
    VerifyOptions options;
    options.lights = 30;
    options.points = 16;
    options.noise = 0.05;
    const Verification found = r.verified({r.picture(), tinted, r.textures()}, options);
    const ErrorSize& indirect = found.shown[1].indirect;
    // Half of the room lies on either side.
    const double truth = std::sqrt(0.5 * (0.1 * 0.1 + 0.05 * 0.05));
    EXPECT_TRUE(nearly_contains(indirect.relative_l2, truth))
        << indirect.relative_l2.low << " to " << indirect.relative_l2.high;
    EXPECT_LT(indirect.relative_l2.high - indirect.relative_l2.low, 0.5 * truth);
    EXPECT_TRUE(nearly_contains(indirect.bias, 0.025));
    // Three quarters of the surface are wrong by 10 or 5 %, nothing by much more.
    EXPECT_GT(indirect.relative[0], 0.03);
    EXPECT_LT(indirect.relative[0], 0.11);
}

// Any forty of many lamps are a repetition; all of them together tell the truth.
TEST(Verification, ItsIntervalContainsTheTrueError) {
    constexpr int repetitions = 400, lights = 40;
    VerifyOptions options;
    options.lights = 500;
    options.points = 32;
    options.noise = 0.2;
    options.candidates = 200;
    options.seed = 3;
    const Verification all = room().verified({room().picture(), room().textures()}, options);
    const std::vector<WeighedValue>& squares = all.shown[0].squares;
    const double truth = all.shown[0].indirect.relative_l2.value;
    RandomStream random(2006);
    int covered = 0;
    for (int r = 0; r < repetitions; ++r) {
        std::vector<WeighedValue> some;
        for (int k = 0; k < lights; ++k)
            some.push_back(squares[random.below(squares.size())]);
        if (contains(rms_interval(some), truth)) ++covered;
    }
    RecordProperty("covered", covered);
    EXPECT_GE(covered, 0.93 * repetitions);
}

TEST(Verification, IsTheSameForTheSameSeedAndNotForAnother) {
    VerifyOptions options;
    options.lights = 4;
    options.points = 4;
    options.noise = 0.2;
    options.candidates = 100;
    const auto value = [&options](std::uint64_t seed) {
        options.seed = seed;
        return room().verified({room().picture()}, options).shown[0].indirect.relative_l2.value;
    };
    EXPECT_EQ(value(1), value(1));
    EXPECT_NE(value(1), value(2));
}

TEST(Verification, NeedsRoomForLamps) {
    Scene scene;
    add_quad(scene, Quad{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}},
             Rgb::Constant(0.5));
    const Visibility visibility = visibility_of(scene);
    const OccluderTree occluders({scene.quads[0].quad});
    EXPECT_THROW(verify(scene, RadianceSpace(), visibility, occluders, {room().picture()}, {}, {}),
                 InputError);
}

TEST(Verification, StopsOnRequest) {
    Progress progress;
    progress.stop_requested = [] { return true; };
    EXPECT_THROW(verify(room().scene, room().transport.space, room().visibility, room().occluders,
                        {room().picture()}, {}, progress),
                 Interrupted);
}

}  // namespace
}  // namespace lightwell
