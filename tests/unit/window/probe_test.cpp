#include "viewer/window/probe.h"

#include <numeric>

#include <gtest/gtest.h>

#include "radiance4d/operator/smooth_irradiance.h"
#include "runtime/propagation/lighting.h"
#include "tests/unit/propagation/coloured_room.h"
#include "viewer/window/probe_reader.h"

namespace lightwell {
namespace {

SharedOperator shared_room() {
    static const SharedOperator room =
        std::make_shared<const OpenedOperator>(opened(testing::coloured_room().transport));
    return room;
}

const std::vector<Light> lamps = {PointLight{"near", {0.6, 0.7, 1.8}, {100, 80, 60}},
                                  PointLight{"far", {2.4, 3.5, 2.2}, {20, 40, 90}}};
/// A point of the floor, that both lamps see.
const ProbedPoint on_floor{{2.0, 1.0, 0}, 4, true};

bool never() {
    return false;
}

TEST(Probe, BouncesOfAllLampsAddUpToTheSolvedLight) {
    const OpenedOperator& room = *shared_room();
    const ProbeReading reading = read_probe(room, lamps, on_floor, never);
    ASSERT_EQ(reading.shares.size(), 2u);
    EXPECT_EQ(reading.shares[1].name, "far");
    const RadianceSpace& space = room.transport.space;
    const RadianceField solved =
        light_scene(room.transport, lamps, room.quads, room.occluders, Propagation::solved)
            .indirect;
    const auto element = static_cast<std::size_t>(space.element_on(4, true));
    const Vec2 uv = space.element(element).geometry.parameters(on_floor.position);
    const double right = luminance(smooth_irradiance(space, element, solved).at(uv[0], uv[1]));
    EXPECT_GT(right, 1);
    EXPECT_NEAR(reading.indirect(), right, 5e-3 * right);
    const auto bounces = reading.bounces();
    EXPECT_NEAR(std::accumulate(bounces.begin(), bounces.end(), 0.0), reading.indirect(), 1e-9);
}

TEST(Probe, DirectLightFollowsTheInverseSquare) {
    const ProbeReading reading = read_probe(*shared_room(), lamps, on_floor, never);
    for (std::size_t k = 0; k < 2; ++k) {
        const auto& lamp = std::get<PointLight>(lamps[k]);
        const Vec3 way = lamp.position - on_floor.position;
        const double right = luminance(lamp.intensity) * way[2] / std::pow(way.norm(), 3);
        EXPECT_NEAR(reading.shares[k].direct, right, 1e-6 * right);
    }
}

TEST(Probe, EmittingSurfacesAreAShareOfTheirOwn) {
    GlobalTransport transport = testing::coloured_room().transport;
    transport.scene.materials[static_cast<std::size_t>(transport.scene.quads[0].material)]
        .emission = Rgb(10, 20, 30);
    const ProbeReading reading = read_probe(opened(std::move(transport)), {}, on_floor, never);
    ASSERT_EQ(reading.shares.size(), 1u);
    EXPECT_GT(reading.direct(), 1);
    EXPECT_GT(reading.indirect(), 1);
}

TEST(ProbeReader, ReadsWhatIsWantedLastAndForgetsWhatIsNot) {
    ProbeReader reader;
    reader.want(shared_room(), lamps, on_floor);
    reader.want(shared_room(), {lamps[0]}, on_floor);
    while (reader.is_reading())
        reader.poll();
    ASSERT_TRUE(reader.reading());
    EXPECT_EQ(reader.reading()->shares.size(), 1u);
    // The same again is not read again.
    reader.want(shared_room(), {lamps[0]}, on_floor);
    EXPECT_FALSE(reader.is_reading());
    reader.want(shared_room(), {lamps[0]}, std::nullopt);
    EXPECT_FALSE(reader.reading());
}

}  // namespace
}  // namespace lightwell
