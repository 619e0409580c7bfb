// What must hold however light is projected: by shadows and rays, or by occlusion queries.
#include <cmath>
#include <memory>
#include <random>
#include <sstream>

#include <gtest/gtest.h>

#include "runtime/projection/occlusion_query_projection.h"
#include "runtime/projection/shadow_projection.h"
#include "tests/shared_reference.h"
#include "tests/unit/projection/lit_rooms.h"
#include "tests/unit/radiance4d/rooms.h"
#include "viewer/offscreen/gl_context.h"

namespace lightwell {
namespace {

using testing::closed_room;
using testing::lamp;
using testing::lit_room;
using testing::LitRoom;
using testing::spot;

enum class Way { shadows, queries };

class BothWays : public ::testing::TestWithParam<Way> {
  protected:
    std::unique_ptr<LightProjection> projection_in(const LitRoom& room) {
        if (GetParam() == Way::shadows)
            return std::make_unique<ShadowProjection>(room.space, room.quads, room.occluders);
        if (!context_) context_ = make_offscreen_context();
        return std::make_unique<OcclusionQueryProjection>(room.space, room.quads, room.occluders,
                                                          context_->loader());
    }
    RadianceField projected(const LitRoom& room, const Light& light) {
        PackedField direct = room.darkness();
        projection_in(room)->project({light}, direct);
        return unpacked(direct);
    }

  private:
    std::unique_ptr<GlContext> context_;
};

/// Whether a point of the closed room is in the free air and not in one of its blocks.
bool is_in_the_open(const LitRoom& room, const Vec3& place) {
    for (const std::size_t first : {6U, 11U}) {
        bool is_inside = true;
        for (std::size_t q = first; q < first + 5; ++q)
            is_inside =
                is_inside && room.quads[q].normal().dot(place - room.quads[q].vertex[0]) < 0;
        if (is_inside) return false;
    }
    return true;
}

/// Lamps anywhere in the closed room: in the air, and a millimetre off one, two or three surfaces,
/// blocks included.
std::vector<Vec3> random_places(const LitRoom& room, int count, unsigned seed) {
    constexpr double near = 1e-3;
    std::mt19937 random(seed);
    const auto uniform = [&] { return std::uniform_real_distribution<double>(0.01, 0.99)(random); };
    const Vec3 size(3, 4, 2.5);
    std::vector<Vec3> places;
    while (static_cast<int>(places.size()) < count) {
        Vec3 place = size.cwiseProduct(Vec3(uniform(), uniform(), uniform()));
        const int kind = static_cast<int>(places.size()) % 5;
        if (kind == 4) {  // beside a block, sometimes its edge
            const Quad& side = room.quads[6 + random() % 10];
            place = side.point(random() % 3 == 0 ? 0 : uniform(), uniform()) + near * side.normal();
        } else {  // near so many walls
            for (int k = 0, axis = static_cast<int>(random() % 3); k < kind;
                 ++k, axis = (axis + 1) % 3)
                place[axis] = random() % 2 == 0 ? near : size[axis] - near;
        }
        if (is_in_the_open(room, place)) places.push_back(place);
    }
    return places;
}

TEST_P(BothWays, LoseNoLightWhereverALampIs) {
    const LitRoom room = closed_room();
    const auto projection = projection_in(room);
    PackedField direct = room.darkness();
    const int count = GetParam() == Way::shadows ? 100 : 15;
    for (const Vec3& place : random_places(room, count, 404)) {
        projection->project({lamp(place)}, direct);
        EXPECT_NEAR(room.total_flux(unpacked(direct)), 4 * M_PI * 100, 2e-3 * 4 * M_PI * 100)
            << place.transpose();
    }
}

TEST_P(BothWays, MatchTheHardShadowOfTheReference) {
    LIGHTWELL_SHARED_JSON(cases, "reference/direct_tests.json");
    const auto& test = cases["point_light_hard_shadow"];
    const auto &b = test["blocker_x1x2y1y2z"], &f = test["floor"];
    const std::vector<Quad> quads = {level_rectangle(f[0], f[1], f[2], f[3], 0),
                                     level_rectangle(b[0], b[1], b[2], b[3], b[4])};
    const PointLight light{"lamp", Vec3(test["light"][0], test["light"][1], test["light"][2]),
                           Rgb::Constant(test["I"])};
    for (const auto& [level, expected] : test["levels"].items()) {
        const double cells = std::exp2(std::stoi(level));
        const LitRoom room = lit_room(quads, 4.001 / cells);
        const RadianceField lux = cell_irradiance(room.space, 0, projected(room, light));
        const CellTree& tree = room.space.element(0).space.tree();
        ASSERT_EQ(static_cast<double>(tree.columns()), cells);
        for (std::uint32_t j = 0; j < tree.rows(); ++j)
            for (std::uint32_t i = 0; i < tree.columns(); ++i) {
                const double wanted = expected[i][j];  // rows run along x
                EXPECT_NEAR(lux(tree.finest_at(i, j), 0), wanted, 0.01 * wanted + 1e-3)
                    << "level " << level << ", cell " << i << ' ' << j;
            }
    }
}

TEST_P(BothWays, MatchTheHardConesOfTheReference) {
    LIGHTWELL_SHARED_JSON(cases, "reference/direct_tests.json");
    // Below a cone of 90 degrees the horizon's light is missing from any floor: here all but 0.5 %
    // of it falls on this one.
    const LitRoom room = lit_room({level_rectangle(-400, 400, -400, 400, 0)}, 25);
    for (const auto& entry : cases["spot"]) {
        if (entry["n"] != 0) continue;  // ours have no cos^n law
        const double half_angle = entry["half_angle_deg"], expected = entry["flux_per_I0"];
        const SpotLight light = spot(Vec3(3, 1, 2), -Vec3::UnitZ(), half_angle, half_angle);
        EXPECT_NEAR(room.total_flux(projected(room, light)), 100 * expected, 1 * expected)
            << half_angle;
    }
}

TEST_P(BothWays, MatchTheGrazingLightsOfTheReference) {
    LIGHTWELL_SHARED_JSON(cases, "reference/direct_tests.json");
    for (const auto& entry : cases["grazing_point_light"]) {
        const double h = entry["h"], r = entry["r"], expected = entry["E_mean_1x1"];
        for (const double cell : {1.1, 0.2}) {
            const LitRoom room = lit_room({level_rectangle(r - 0.5, r + 0.5, -0.5, 0.5, 0)}, cell);
            EXPECT_NEAR(room.total_flux(projected(room, lamp(Vec3(0, 0, h)))), 100 * expected,
                        1 * expected)
                << h << ' ' << r << ", cells of " << cell;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Projection, BothWays, ::testing::Values(Way::shadows, Way::queries),
                         [](const auto& way) {
                             return way.param == Way::shadows ? "Shadows" : "Queries";
                         });

}  // namespace
}  // namespace lightwell
