#include "solver/reference/lamp_draw.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/reference/rooms.h"

namespace lightwell {
namespace {

Scene grey_room() {
    std::array<Rgb, 6> grey;
    grey.fill(Rgb::Constant(0.5));
    return box_scene({4, 3, 2.5}, grey);
}

/// Of lamps close to a wall a hundred times as much as of the others.
std::vector<double> stakes_at_the_wall(const std::vector<Vec3>& places) {
    std::vector<double> stakes;
    for (const Vec3& place : places)
        stakes.push_back(place[0] < 0.4 ? 100 : 1);
    return stakes;
}

TEST(LampDraw, TakesALampAtATimeAsWellAsManyAtOnce) {
    const Scene scene = grey_room();
    const Visibility visibility = visibility_of(scene);
    LampDraw at_once(scene, visibility, 7), bit_by_bit(scene, visibility, 7);
    const std::vector<DrawnLamp> all = at_once.more(40, stakes_at_the_wall, {});
    ASSERT_EQ(all.size(), 40U);
    std::vector<DrawnLamp> gathered;
    for (const int count : {1, 2, 5, 8, 24})
        for (const DrawnLamp& lamp : bit_by_bit.more(count, stakes_at_the_wall, {}))
            gathered.push_back(lamp);
    ASSERT_EQ(gathered.size(), all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
        EXPECT_EQ(gathered[k].position, all[k].position) << k;
        EXPECT_EQ(gathered[k].weight, all[k].weight) << k;
    }
}

// Weights make up for what is drawn oftener: the share of lamps at the wall comes out as it is, and
// with less noise than if lamps were drawn evenly.
TEST(LampDraw, TakesOftenerWhatMattersAndCountsItLess) {
    const Scene scene = grey_room();
    const Visibility visibility = visibility_of(scene);
    LampDraw draw(scene, visibility, 3);
    double all = 0, at_wall = 0;
    int drawn_at_wall = 0;
    constexpr int count = 2000;
    for (const DrawnLamp& lamp : draw.more(count, stakes_at_the_wall, {})) {
        EXPECT_GE(lamp.weight, 1);
        EXPECT_LE(lamp.weight, 10);
        all += lamp.weight;
        if (lamp.position[0] >= 0.4) continue;
        at_wall += lamp.weight;
        ++drawn_at_wall;
    }
    // As far from walls as places are, the share of the room where x < 0.4.
    const double clearance = 0.02 * std::sqrt(16 + 9 + 6.25);
    const double share = (0.4 - clearance) / (4 - 2 * clearance);
    EXPECT_NEAR(at_wall / all, share, 0.15 * share);
    EXPECT_GT(drawn_at_wall, 3 * share * count);
}

TEST(LampDraw, IsEvenWhereNothingIsKnown) {
    const Scene scene = grey_room();
    const Visibility visibility = visibility_of(scene);
    LampDraw draw(scene, visibility, 5);
    const auto nothing = [](const std::vector<Vec3>& places) {
        return std::vector<double>(places.size(), 0.0);
    };
    for (const DrawnLamp& lamp : draw.more(20, nothing, {}))
        EXPECT_EQ(lamp.weight, 5);
}

TEST(LampDraw, HasNoneWhereThereIsNoRoom) {
    Scene plate;
    add_quad(plate, Quad{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}},
             Rgb::Constant(0.5));
    const Visibility visibility = visibility_of(plate);
    LampDraw draw(plate, visibility, 5);
    EXPECT_TRUE(draw.more(4, stakes_at_the_wall, {}).empty());
}

TEST(LampDraw, StopsOnRequest) {
    const Scene scene = grey_room();
    const Visibility visibility = visibility_of(scene);
    LampDraw draw(scene, visibility, 5);
    Progress stopped;
    stopped.stop_requested = [] { return true; };
    EXPECT_THROW(draw.more(4, stakes_at_the_wall, stopped), Interrupted);
}

}  // namespace
}  // namespace lightwell
