#include "runtime/projection/shadow_projection.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "radiance4d/scene/visibility.h"
#include "tests/unit/projection/lit_rooms.h"
#include "tests/unit/radiance4d/rooms.h"

namespace lightwell {
namespace {

using testing::closed_room;
using testing::expect_same_flux;
using testing::Flicker;
using testing::flicker_of;
using testing::lamp;
using testing::lit_room;
using testing::LitRoom;
using testing::places_in_closed_room;
using testing::spot;

RadianceField projected(const LitRoom& room, const std::vector<Light>& lights) {
    ShadowProjection projection(room.space, room.quads, room.occluders);
    PackedField direct = PackedField::Constant(4, room.space.functions(), 1e6F);
    projection.project(lights, direct);
    EXPECT_TRUE((direct.row(3) == 0).all());
    return unpacked(direct);
}

TEST(ShadowProjection, AgreesWithTheExactProjectorWhereverTheLampIs) {
    const LitRoom room = closed_room();
    for (const Vec3& place : places_in_closed_room(12)) {
        const RadianceField truth = room.truth({lamp(place)});
        const RadianceField field = projected(room, {lamp(place)});
        std::ostringstream name;
        name << "lamp at " << place.transpose();
        expect_same_flux(room, field, truth, 5e-3, 1e-3, name.str());
        EXPECT_LT((field - truth).matrix().norm(), 3e-3 * truth.matrix().norm()) << name.str();
    }
}

TEST(ShadowProjection, LosesNoLightOfALampInAClosedRoom) {
    const LitRoom room = closed_room();
    for (const Vec3& place : places_in_closed_room(12))
        EXPECT_NEAR(room.total_flux(projected(room, {lamp(place)})), 4 * M_PI * 100,
                    2e-3 * 4 * M_PI * 100)
            << place.transpose();
}

TEST(ShadowProjection, AgreesForSpotsOfAnyCone) {
    const LitRoom room = closed_room();
    const double cones[][2] = {{20, 30}, {5, 70}, {40, 40}, {100, 140}, {0, 15}};
    for (const auto& cone : cones)
        for (const Vec3& place : places_in_closed_room(4)) {
            const std::vector<Light> light = {
                spot(place, Vec3(1.5, 2, 1.2) - place, cone[0], cone[1])};
            std::ostringstream name;
            name << "spot at " << place.transpose() << ", " << cone[0] << " to " << cone[1];
            const RadianceField field = projected(room, light), truth = room.truth(light);
            expect_same_flux(room, field, truth, 5e-3, 2e-3, name.str(), 5e-3);
            // Where a cone's rim and several shadows meet in one cell, and nowhere else.
            expect_same_flux(room, field, truth, 1e-2, 2e-3, name.str());
        }
}

TEST(ShadowProjection, AgreesOnQuadsThatAreNoParallelograms) {
    std::vector<Quad> quads = {
        Quad{{Vec3(0, 0, 0), Vec3(4, 0.5, 0), Vec3(2.8, 3, 0), Vec3(0.6, 2, 0)}},
        Quad{{Vec3(1, 0.8, 0.7), Vec3(2, 1, 0.8), Vec3(1.7, 1.6, 0.8), Vec3(1.2, 1.5, 0.735)}}};
    const LitRoom room = lit_room(quads, 0.15);
    const std::vector<Light> light = {lamp(Vec3(1.1, 0.9, 2.3))};
    expect_same_flux(room, projected(room, light), room.truth(light), 2e-3, 2e-3, "trapezoids");
}

TEST(ShadowProjection, SeesWhatIsThinnerThanAnyRays) {
    const Quad floor = level_rectangle(0, 4, 0, 4, 0);
    const std::vector<Quad> quads = {floor, level_rectangle(1.9, 1.902, 0.2, 3.8, 1)};
    const LitRoom room = lit_room(quads, 0.25);
    const std::vector<Light> light = {lamp(Vec3(2.2, 2, 2.5))};
    const double hidden =
        room.flux(0, lit_room({floor}, 0.25).truth(light)) - room.flux(0, room.truth(light));
    const double hidden_here = room.flux(0, projected(lit_room({floor}, 0.25), light)) -
                               room.flux(0, projected(room, light));
    ASSERT_GT(hidden, 0);
    EXPECT_NEAR(hidden_here, hidden, 0.05 * hidden);
}

// The slow and obvious way: very many rays to every cell.
TEST(ShadowProjection, AgreesWithManyRays) {
    const LitRoom room = closed_room(0.5);
    const Visibility visibility(room.quads);
    const Vec3 place(1.3, 0.8, 2.2);
    const RadianceField field = projected(room, {lamp(place)});
    for (std::size_t e = 0; e < room.space.elements().size(); ++e) {
        const Element& element = room.space.element(e);
        const Vec3 normal = element.geometry.normal();
        constexpr int n = 300;
        double flux = 0;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const double u = (i + 0.5) / n, v = (j + 0.5) / n;
                const Vec3 point = element.geometry.point(u, v), way = place - point;
                if (!(normal.dot(way) > 0) ||
                    visibility.occluded(point, element.quad, place, free_point))
                    continue;
                flux += 100 * normal.dot(way) / std::pow(way.norm(), 3) *
                        element.geometry.jacobian(u, v) / (n * n);
            }
        EXPECT_NEAR(room.flux(e, field), flux, 3e-3 * flux + 1e-3) << "element " << e;
    }
}

TEST(ShadowProjection, DoesNotFlicker) {
    const LitRoom room = closed_room();
    ShadowProjection projection(room.space, room.quads, room.occluders);
    const Flicker flicker = flicker_of(room, projection, 200);
    EXPECT_LE(flicker.second_difference, 2e-3);
    EXPECT_LE(flicker.largest_step, 5e-3);
}

TEST(ShadowProjection, LightsAddUp) {
    const LitRoom room = closed_room();
    const Light first = lamp(Vec3(0.4, 0.5, 1.9));
    const Light second = spot(Vec3(2.5, 3.4, 2.2), Vec3(-0.3, -1, -1), 20, 40);
    const RadianceField sum = projected(room, {first}) + projected(room, {second});
    EXPECT_LT((projected(room, {first, second}) - sum).matrix().norm(), 1e-6 * sum.matrix().norm());
}

TEST(ShadowProjection, NoLampsAreDarkness) {
    const LitRoom room = closed_room();
    EXPECT_TRUE((projected(room, {}) == 0).all());
}

TEST(ShadowProjection, ChannelsFollowTheColour) {
    const LitRoom room = closed_room();
    const RadianceField field = projected(room, {lamp(Vec3(0.4, 0.5, 1.9))});
    EXPECT_LT((field.col(1) - 0.6 * field.col(0)).matrix().norm(), 1e-6 * field.matrix().norm());
    EXPECT_LT((field.col(2) - 0.3 * field.col(0)).matrix().norm(), 1e-6 * field.matrix().norm());
}

TEST(ShadowProjection, GivesTheSameBytesOnOneThreadAndOnMany) {
    const LitRoom room = closed_room();
    const std::vector<Light> lights = {lamp(Vec3(0.4, 0.5, 1.9)), lamp(Vec3(2.4, 3.5, 0.4))};
    ShadowProjection projection(room.space, room.quads, room.occluders);
    PackedField one = room.darkness(), many = room.darkness();
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        projection.project(lights, one);
    }
    projection.project(lights, many);
    EXPECT_TRUE((one == many).all());
}

TEST(ShadowProjection, FewCellsHoldEdgesAndFewOfThemNeedRays) {
    const LitRoom room = closed_room(0.1);
    ShadowProjection projection(room.space, room.quads, room.occluders);
    PackedField direct = room.darkness();
    projection.project({lamp(Vec3(0.4, 0.5, 1.9))}, direct);
    const ShadowProjectionReport& report = projection.report();
    EXPECT_GT(report.lit_cells, room.space.functions() / 3);
    EXPECT_GT(report.edge_cells, 0U);
    EXPECT_LT(report.edge_cells, report.lit_cells / 4);
    EXPECT_LT(report.rays, 20 * report.edge_cells);
}

}  // namespace
}  // namespace lightwell
