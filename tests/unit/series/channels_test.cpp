// Colours share an operator where their reflectances are the same, and never mix.
#include <gtest/gtest.h>

#include "radiance4d/scene/scene_quads.h"
#include "runtime/propagation/lighting.h"
#include "solver/precompute.h"
#include "tests/unit/reference/rooms.h"

namespace lightwell {
namespace {

Scene room(const Rgb& floor) {
    std::array<Rgb, 6> reflectance;
    reflectance.fill(Rgb::Constant(0.5));
    reflectance[floor_z0] = floor;
    reflectance[ceiling_z1] = Rgb::Constant(0.75);
    return box_scene({6, 4, 3}, reflectance);
}

GlobalTransport transport_of(const Scene& scene, bool exact = false) {
    PrecomputeOptions options;
    options.error = 0.1;
    options.most_attempts = 0;
    if (exact) {
        options.cell_size = 1.6;
        options.truncation = 0;
    }
    PrecomputeReport report;
    return precompute(scene, options, {}, report);
}

Lighting two_lights(const GlobalTransport& transport, Propagation propagation) {
    const std::vector<Quad> quads = quads_of(transport.scene);
    return light_scene(
        transport, {lamp_at({1.5, 2, 2}, {1000, 0, 500}), lamp_at({4.5, 1.5, 1.8}, {0, 1000, 500})},
        quads, OccluderTree(quads), propagation);
}

TEST(Channels, GreyScenesHaveOneOperator) {
    const GlobalTransport grey = transport_of(room(Rgb::Constant(0.25)));
    EXPECT_EQ(grey.indirect.size(), 1U);
    EXPECT_EQ(grey.channel, (std::array<int, 3>{0, 0, 0}));
}

TEST(Channels, EqualChannelsShareAnOperator) {
    const GlobalTransport green_is_blue = transport_of(room({0.25, 0.4, 0.4}));
    EXPECT_EQ(green_is_blue.indirect.size(), 2U);
    EXPECT_EQ(green_is_blue.channel, (std::array<int, 3>{0, 1, 1}));
    const GlobalTransport red_is_blue = transport_of(room({0.4, 0.25, 0.4}));
    EXPECT_EQ(red_is_blue.indirect.size(), 2U);
    EXPECT_EQ(red_is_blue.channel, (std::array<int, 3>{0, 1, 0}));
    const GlobalTransport all_differ = transport_of(room({0.1, 0.25, 0.4}));
    EXPECT_EQ(all_differ.indirect.size(), 3U);
    EXPECT_EQ(all_differ.channel, (std::array<int, 3>{0, 1, 2}));
}

TEST(Channels, LightIsLinear) {
    const GlobalTransport transport = transport_of(room(Rgb::Constant(0.25)));
    for (const Propagation way :
         {Propagation::stored, Propagation::gathered, Propagation::solved}) {
        const Lighting lighting = two_lights(transport, way);
        for (const RadianceField* field : {&lighting.direct, &lighting.indirect}) {
            const Eigen::ArrayXd halves = 0.5 * (field->col(0) + field->col(1));
            EXPECT_GT(halves.abs().maxCoeff(), 1);
            EXPECT_LT((field->col(2) - halves).abs().maxCoeff(), 1e-6 * halves.abs().maxCoeff());
        }
    }
}

TEST(Channels, ColoursDoNotMix) {
    const GlobalTransport grey = transport_of(room(Rgb::Constant(0.25)), true);
    const GlobalTransport red = transport_of(room({0.9, 0.25, 0.25}), true);
    for (const Propagation way : {Propagation::stored, Propagation::gathered}) {
        const RadianceField a = two_lights(grey, way).indirect, b = two_lights(red, way).indirect;
        const double scale = a.abs().maxCoeff();
        EXPECT_LT((a.rightCols(2) - b.rightCols(2)).abs().maxCoeff(), 1e-7 * scale);
        EXPECT_GT((a.col(0) - b.col(0)).abs().maxCoeff(), 1e-2 * scale);
    }
}

}  // namespace
}  // namespace lightwell
