#include "runtime/projection/directed_cells.h"

#include <gtest/gtest.h>

#include "radiance4d/basis/angular_reflection.h"
#include "runtime/projection/shadow_projection.h"
#include "tests/unit/projection/lit_rooms.h"

namespace lightwell {
namespace {

/// The closed room with directions on every second element.
testing::LitRoom partly_glossy_room() {
    testing::LitRoom room = testing::closed_room(0.4);
    std::vector<Element> elements = room.space.elements();
    for (std::size_t e = 0; e < elements.size(); e += 2)
        elements[e].angle = angular_basis(e % 4 == 0 ? 3 : 2).tree();
    room.space = RadianceSpace(elements);
    return room;
}

TEST(DirectedCells, LightOnGlossyElementsKeepsItsDirection) {
    const testing::LitRoom room = partly_glossy_room();
    const std::vector<Light> lights = {
        testing::lamp(Vec3(1.1, 0.7, 2.2)),
        testing::spot(Vec3(2.5, 3.0, 1.9), Vec3(-0.4, -0.5, -1), 30, 50)};
    ShadowProjection projection(room.space, room.quads, room.occluders);
    PackedField direct = PackedField::Constant(4, room.space.functions(), 1e6F);
    projection.project({testing::lamp(Vec3(1.9, 1.7, 0.3))}, direct);
    projection.project(lights, direct);
    const RadianceField truth = room.truth(lights), field = unpacked(direct);
    EXPECT_LT((field - truth).matrix().norm(), 3e-3 * truth.matrix().norm());
    EXPECT_TRUE((direct.row(3) == 0).all());
    // Most of it is in the directions, so that this says something.
    double in_directions = 0;
    for (const Element& element : room.space.elements())
        for (std::uint32_t f = 0; f < element.functions(); ++f)
            if (f % element.angle.functions() != 0)
                in_directions += truth.row(element.first + f).square().sum();
    EXPECT_GT(in_directions, 0.5 * truth.square().sum());
}

TEST(DirectedCells, DarknessLeavesNothingBehind) {
    const testing::LitRoom room = partly_glossy_room();
    ShadowProjection projection(room.space, room.quads, room.occluders);
    PackedField direct = PackedField::Constant(4, room.space.functions(), 1e6F);
    projection.project({testing::lamp(Vec3(1.9, 1.7, 0.3))}, direct);
    EXPECT_GT(direct.abs().sum(), 0);
    projection.project({}, direct);
    EXPECT_EQ(direct.abs().sum(), 0);
}

}  // namespace
}  // namespace lightwell
