#include "radiance4d/scene/direct_light.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/shared_reference.h"
#include "tests/unit/radiance4d/rooms.h"

namespace lightwell {
namespace {

/// A scene of grey quads, and what direct light needs to know of it.
class Room {
  public:
    explicit Room(const std::vector<Quad>& quads) {
        scene_.materials.resize(2);
        for (const Quad& quad : quads)
            scene_.quads.push_back({quad, 0, 0, 0});
        geometry_ = quads;
    }
    /// Adds a quad that emits a luminance.
    Room& with_lamp(const Quad& quad, double emitted, Sides sides = Sides::front) {
        scene_.materials[1].emission = Rgb(emitted, 2 * emitted, 0);
        scene_.materials[1].emitting = sides;
        scene_.quads.push_back({quad, 1, 0, 0});
        geometry_.push_back(quad);
        return *this;
    }
    Rgb irradiance(const Vec3& point, const Vec3& normal, int on_quad,
                   const std::vector<Light>& lights = {}) const {
        const Visibility visibility(geometry_);
        const OccluderTree occluders(geometry_);
        return DirectLight(scene_, visibility, occluders)
            .irradiance(point, normal, on_quad, lights);
    }

  private:
    Scene scene_;
    std::vector<Quad> geometry_;
};

const Vec3 up = Vec3::UnitZ();

TEST(DirectLight, Cie171Case52PointSource) {
    LIGHTWELL_SHARED_JSON(cases, "reference/cie171.json");
    const Room room({level_rectangle(-3, 3, -3, 3, 0)});
    const PointLight lamp{"lamp", Vec3(0, 0, 3), Rgb(1000, 500, 0)};
    int compared = 0;
    for (const auto& entry : cases["5.2_point_source"]["points"]) {
        const double expected = entry["E_isotropic_1000cd"];
        const Vec3 x(entry["xy"][0], entry["xy"][1], 0);
        const Rgb found = room.irradiance(x, up, 0, {lamp});
        EXPECT_NEAR(found[0], expected, 1e-12 * expected);
        EXPECT_NEAR(found[1], 0.5 * expected, 1e-12 * expected);
        EXPECT_EQ(found[2], 0);
        ++compared;
    }
    EXPECT_EQ(compared, 10);
}

TEST(DirectLight, Cie171Case56SquareSeenFromWallAndCeiling) {
    LIGHTWELL_SHARED_JSON(cases, "reference/cie171.json");
    for (const auto& [name, size] :
         {std::pair{"S2=0.5m", 0.5}, std::pair{"S2=4.0m", 4.0}, std::pair{"S2=500.0m", 500.0}}) {
        const auto& values = cases["5.6_diffuse_reflection"]["values"][name];
        const double h = 0.5 * size;
        Room room({});
        // Exitance 100, so that the illuminance is the tabulated percentage.
        room.with_lamp(level_rectangle(2 - h, 2 + h, 2 - h, 2 + h, 0), 100 / M_PI);
        for (int i = 0; i < 6; ++i) {
            const double expected = values[std::string(1, static_cast<char>('A' + i))];
            EXPECT_NEAR(room.irradiance(Vec3(2, 0, 0.25 + 0.5 * i), Vec3::UnitY(), free_point)[0],
                        expected, 1e-9 * expected)
                << name << " wall point " << i;
        }
        for (int i = 0; i < 8; ++i) {
            const double expected = values[std::string(1, static_cast<char>('G' + i))];
            EXPECT_NEAR(room.irradiance(Vec3(2, 0.25 + 0.5 * i, 3), -up, free_point)[0], expected,
                        1e-9 * expected)
                << name << " ceiling point " << i;
        }
    }
}

TEST(DirectLight, PenumbraOfTheReference) {
    LIGHTWELL_SHARED_JSON(cases, "reference/direct_tests.json");
    Room room({level_rectangle(-4, 4, -4, 4, 0), level_rectangle(-0.3, 0.7, -0.5, 0.5, 1.5)});
    room.with_lamp(level_rectangle(-0.5, 0.5, -0.5, 0.5, 3).reversed(), 1000);
    for (const auto& point : cases["area_light_penumbra"]["profile_y0"]) {
        const double open = point[1], shadowed = point[2];
        EXPECT_NEAR(room.irradiance(Vec3(point[0], 0, 0), up, 0)[0], shadowed, 1e-10 * open);
        EXPECT_NEAR(room.irradiance(Vec3(point[0], 0, 0), up, free_point)[1], 2 * shadowed,
                    2e-10 * open);
    }
}

TEST(DirectLight, GrazingLightsOfTheReference) {
    LIGHTWELL_SHARED_JSON(cases, "reference/direct_tests.json");
    const Room room({level_rectangle(-20, 20, -20, 20, 0)});
    for (const auto& entry : cases["grazing_point_light"]) {
        const double h = entry["h"], r = entry["r"], expected = entry["E_point"];
        const PointLight lamp{"lamp", Vec3(0, 0, h), Rgb::Ones()};
        EXPECT_NEAR(room.irradiance(Vec3(r, 0, 0), up, 0, {lamp})[0], expected, 1e-11 * expected)
            << h << " " << r;
    }
}

// The irradiance of a spot, integrated over a floor in rings, is the light's flux.
TEST(DirectLight, ASpotsFluxArrivesOnTheFloor) {
    const std::vector<Quad> floor{level_rectangle(-100, 100, -100, 100, 0)};
    Scene scene;
    scene.materials.resize(1);
    scene.quads.push_back({floor[0], 0, 0, 0});
    const Visibility visibility(floor);
    const OccluderTree occluders(floor);
    const DirectLight direct(scene, visibility, occluders);
    const SpotLight lamp{"lamp", Vec3(1, 2, 3), Rgb::Constant(7), -up, 20, 50};
    const double radian = M_PI / 180;
    const int rings = 20000;
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        const double angle = 55 * radian * (i + 0.5) / rings, r = 3 * std::tan(angle);
        const double width = 55 * radian / rings * 3 / std::pow(std::cos(angle), 2);
        const Vec3 x = Vec3(1, 2, 0) + r * Vec3(std::cos(i), std::sin(i), 0);
        sum += direct.irradiance(x, up, 0, {lamp})[2] * 2 * M_PI * r * width;
    }
    const double expected =
        7 * 2 * M_PI * (1 - 0.5 * (std::cos(20 * radian) + std::cos(50 * radian)));
    EXPECT_NEAR(sum, expected, 1e-6 * expected);
}

TEST(DirectLight, ABlockerHidesAPointLight) {
    const Room room({level_rectangle(0, 4, 0, 4, 0), level_rectangle(1.5, 2.5, 1.25, 2, 1)});
    const PointLight lamp{"lamp", Vec3(1.7, 2.2, 3), Rgb::Constant(1000)};
    EXPECT_EQ(room.irradiance(Vec3(2, 1.5, 0), up, 0, {lamp})[0], 0);
    EXPECT_GT(room.irradiance(Vec3(1.39, 1.5, 0), up, 0, {lamp})[0], 50);
    EXPECT_EQ(room.irradiance(Vec3(1.41, 1.5, 0), up, 0, {lamp})[0], 0);
}

TEST(DirectLight, EmissionLeavesTheSidesThatTheMaterialSays) {
    const Quad lamp = level_rectangle(-1, 1, -1, 1, 1);
    Room one({}), two({});
    one.with_lamp(lamp, 10);
    two.with_lamp(lamp, 10, Sides::both);
    const Vec3 above(0, 0, 2), below(0, 0, 0);
    EXPECT_GT(one.irradiance(above, -up, free_point)[0], 1);
    EXPECT_EQ(one.irradiance(below, up, free_point)[0], 0);
    EXPECT_DOUBLE_EQ(two.irradiance(below, up, free_point)[0],
                     one.irradiance(above, -up, free_point)[0]);
}

TEST(DirectLight, ALampFlushWithTheCeilingShines) {
    const Quad ceiling = level_rectangle(-3, 3, -3, 3, 2.7).reversed();
    const Quad panel = level_rectangle(-0.5, 0.5, -0.5, 0.5, 2.7).reversed();
    Room alone({}), flush({ceiling}), turned({placed(ceiling, some_turn(), Vec3(50, 0, 0))});
    const double expected =
        alone.with_lamp(panel, 1000).irradiance(Vec3(0.3, 0, 0), up, free_point)[0];
    EXPECT_GT(expected, 100);
    EXPECT_NEAR(flush.with_lamp(panel, 1000).irradiance(Vec3(0.3, 0, 0), up, free_point)[0],
                expected, 1e-12 * expected);
    turned.with_lamp(placed(panel, some_turn(), Vec3(50, 0, 0)), 1000);
    EXPECT_NEAR(turned.irradiance(some_turn() * Vec3(0.3, 0, 0) + Vec3(50, 0, 0), some_turn() * up,
                                  free_point)[0],
                expected, 1e-12 * expected);
}

TEST(DirectLight, DegeneratePlacesAreFinite) {
    Room room({level_rectangle(-2, 2, -2, 2, 0)});
    room.with_lamp(level_rectangle(-1, 1, -1, 1, 0), 1000, Sides::both);
    const Vec3 x(0.25, 0.5, 0);
    const PointLight at{"", x, Rgb::Ones()};
    const PointLight in_plane{"", Vec3(1, 0, 0), Rgb::Ones()};
    const PointLight below{"", Vec3(0, 0, -1), Rgb::Ones()};
    EXPECT_EQ(room.irradiance(x, up, 0, {at, in_plane, below}).abs().maxCoeff(), 0);
    EXPECT_EQ(room.irradiance(x, up, 1, {at, in_plane, below}).abs().maxCoeff(), 0);
    EXPECT_EQ(room.irradiance(Vec3(1, 1, 0), Vec3::UnitX(), free_point).abs().maxCoeff(), 0);
    EXPECT_EQ(room.irradiance(Vec3(5, 1, 0), -Vec3::UnitX(), free_point).abs().maxCoeff(), 0);
    EXPECT_TRUE(room.irradiance(x + 1e-12 * up, -up, free_point).allFinite());
    EXPECT_NEAR(room.irradiance(x + 1e-9 * up, -up, free_point)[0], 1000 * M_PI, 1e-3);
}

TEST(DirectLight, InAnEmittersPlaneUpToRoundingIsDark) {
    std::mt19937 random(47);
    const Quad lamp = placed(level_rectangle(-1, 1, -1, 1, 0), some_turn(), Vec3(30, -20, 10));
    Room room({});
    room.with_lamp(lamp, 1000, Sides::both);
    for (int k = 0; k < 200; ++k) {
        const Vec3 where = random_point(random);
        const Vec3 x = lamp.point(where[0], where[1]);
        EXPECT_EQ(room.irradiance(x, lamp.normal(), free_point)[0], 0);
        EXPECT_EQ(room.irradiance(x, -lamp.normal(), free_point)[0], 0);
    }
}

// Closure with shadows: a room whose walls all emit L gives pi L everywhere, whatever stands in it,
// if what stands there emits too.
TEST(DirectLight, AGlowingRoomWithGlowingThingsIsUniform) {
    std::mt19937 random(41);
    for (const double scale : {1e-3, 1.0, 1e3}) {
        Room room({});
        for (const Quad& wall : box_walls(Vec3::Zero(), Vec3::Ones()))
            room.with_lamp(placed(wall, scale * some_turn(), Vec3::Zero()), 100, Sides::both);
        std::mt19937 things(43);
        for (int q = 0; q < 30; ++q) {
            const Quad thing = random_parallelogram(things, 0.4);
            room.with_lamp(placed(thing, scale * some_turn(), Vec3::Zero()), 100, Sides::both);
        }
        for (int k = 0; k < 20; ++k) {
            const Vec3 x = scale * (some_turn() * random_point(random));
            const double found = room.irradiance(x, random_direction(random), free_point)[0];
            ASSERT_NEAR(found, 100 * M_PI, 100 * M_PI * 1e-9) << k << " at scale " << scale;
        }
    }
}

}  // namespace
}  // namespace lightwell
