#include "runtime/projection/occlusion_query_projection.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "runtime/projection/shadow_projection.h"
#include "tests/unit/projection/lit_rooms.h"
#include "tests/unit/radiance4d/rooms.h"
#include "viewer/offscreen/gl_context.h"

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

class OcclusionQueries : public ::testing::Test {
  protected:
    RadianceField projected(const LitRoom& room, const std::vector<Light>& lights,
                            const OcclusionQueryOptions& options = {}) {
        OcclusionQueryProjection projection(room.space, room.quads, room.occluders,
                                            context_->loader(), options);
        PackedField direct = PackedField::Constant(4, room.space.functions(), 1e6F);
        projection.project(lights, direct);
        EXPECT_TRUE((direct.row(3) == 0).all());
        queries_ = projection.queries();
        return unpacked(direct);
    }

    std::unique_ptr<GlContext> context_ = make_offscreen_context();
    std::uint64_t queries_ = 0;
};

TEST_F(OcclusionQueries, AgreeWithShadowsAndTheExactProjectorWhereverTheLampIs) {
    const LitRoom room = closed_room();
    ShadowProjection shadows(room.space, room.quads, room.occluders);
    for (const Vec3& place : places_in_closed_room(4)) {
        const std::vector<Light> light = {lamp(place)};
        const RadianceField field = projected(room, light);
        std::ostringstream name;
        name << "lamp at " << place.transpose();
        expect_same_flux(room, field, room.truth(light), 5e-3, 2e-3, name.str());
        PackedField direct = room.darkness();
        shadows.project(light, direct);
        expect_same_flux(room, field, unpacked(direct), 5e-3, 2e-3, name.str() + ", shadows");
    }
}

TEST_F(OcclusionQueries, LoseNoLightOfALampInAClosedRoom) {
    const LitRoom room = closed_room();
    for (const Vec3& place : places_in_closed_room(4))
        EXPECT_NEAR(room.total_flux(projected(room, {lamp(place)})), 4 * M_PI * 100,
                    2e-3 * 4 * M_PI * 100)
            << place.transpose();
}

TEST_F(OcclusionQueries, AgreeForSpotsOfAnyCone) {
    const LitRoom room = closed_room();
    const double cones[][2] = {{20, 35}, {5, 70}, {40, 40}};
    for (const auto& cone : cones)
        for (const Vec3& place : {Vec3(0.5, 0.6, 2.2), Vec3(2.6, 3.5, 1.3)}) {
            const std::vector<Light> light = {
                spot(place, Vec3(1.5, 2, 0.4) - place, cone[0], cone[1])};
            std::ostringstream name;
            name << "spot at " << place.transpose() << ", " << cone[0] << " to " << cone[1];
            // The rim of a hard cone is no edge that pixels are counted along.
            const double tolerance = cone[0] < cone[1] ? 5e-3 : 1e-2;
            expect_same_flux(room, projected(room, light), room.truth(light), tolerance, 2e-3,
                             name.str());
        }
}

TEST_F(OcclusionQueries, AreFewWhereNothingStandsBetween) {
    const LitRoom room = lit_room(box_walls(Vec3::Zero(), Vec3(2, 3, 4)), 0.1);
    const std::vector<Light> light = {lamp(Vec3(0.7, 1.2, 2.9))};
    const RadianceField field = projected(room, light);
    EXPECT_LE(queries_, 6U * 6U * 2U);
    EXPECT_LT((field - room.truth(light)).matrix().norm(), 1e-3 * field.matrix().norm());
}

TEST_F(OcclusionQueries, AQuadInThePlaneOfAnotherDoesNotHideIt) {
    const Quad floor = level_rectangle(0, 2, 0, 2, 0), patch = level_rectangle(0.5, 1, 0.5, 1, 0);
    const LitRoom room = lit_room({floor, patch}, 0.25);
    const std::vector<Light> light = {lamp(Vec3(0.9, 1.3, 1.7))};
    expect_same_flux(room, projected(room, light), room.truth(light), 1e-3, 1e-3, "patch");
}

/// A rectangle that faces -x.
Quad upright(double x, double y0, double y1, double z0, double z1) {
    return {{Vec3(x, y0, z0), Vec3(x, y0, z1), Vec3(x, y1, z1), Vec3(x, y1, z0)}};
}

// A plate behind a bar, and the wall behind a slit of 4 cm: some 50 and 6 pixels of a face of the
// cube.
TEST_F(OcclusionQueries, CountSmallAndNearlyDarkSidesAsExactlyAsOthers) {
    std::vector<Quad> quads = box_walls(Vec3::Zero(), Vec3(6, 3, 3));
    quads.push_back(upright(3.6, 1, 1.31, 1.03, 1.33));
    quads.push_back(upright(3.5, 0.9, 1.4, 1.08, 1.12));
    quads.push_back(upright(4, 0, 1.83, 0, 3));
    quads.push_back(upright(4, 1.87, 3, 0, 3));
    const LitRoom room = lit_room(quads, 0.2);
    for (const Vec3& place : {Vec3(0.4, 1.217, 1.62), Vec3(0.9, 2.37, 2.71)}) {
        const std::vector<Light> light = {lamp(place)};
        std::ostringstream name;
        name << "lamp at " << place.transpose();
        expect_same_flux(room, projected(room, light), room.truth(light), 5e-3, 2e-3, name.str());
    }
}

/// The relative error of the flux on an element.
double error_on(const LitRoom& room, std::size_t element, const RadianceField& field,
                const std::vector<Light>& lights) {
    return std::abs(room.flux(element, field) / room.flux(element, room.truth(lights)) - 1);
}

// A plate in the far corner of a hall, half behind a bar: some 30 pixels of a face of the cube.
TEST_F(OcclusionQueries, LookCloserWhereACubeShowsTooLittle) {
    std::vector<Quad> quads = box_walls(Vec3::Zero(), Vec3(12, 6, 5));
    quads.push_back(upright(11, 5, 5.3, 1, 1.3));
    quads.push_back(upright(10.5, 4.6, 4.94, 0.9, 1.5));
    const LitRoom room = lit_room(quads, 0.5);
    OcclusionQueryOptions once;
    once.most_looks = 0;
    double worst_at_once = 0;
    for (int k = 0; k < 4; ++k) {
        const std::vector<Light> light = {lamp(Vec3(0.43 + 0.05 * k, 0.62, 2.3))};
        const double exact = room.flux(6, room.truth(light));
        ASSERT_GT(exact, 0);
        const LitRoom alone = lit_room({quads[6]}, 0.5);
        ASSERT_LT(exact, 0.9 * alone.flux(0, alone.truth(light)));
        EXPECT_LT(error_on(room, 6, projected(room, light), light), 5e-3) << k;
        worst_at_once =
            std::max(worst_at_once, error_on(room, 6, projected(room, light, once), light));
    }
    EXPECT_GT(worst_at_once, 5e-3);
}

// Pixels of a cell count alike, but light from near does not fall on them alike.
TEST_F(OcclusionQueries, LookBelowCellsThatLightFallsOnUnevenly) {
    const LitRoom room =
        lit_room({level_rectangle(0, 4, 0, 4, 0), level_rectangle(2.1, 2.6, 1.7, 2.4, 0.3)}, 1.05);
    const std::vector<Light> light = {lamp(Vec3(1.8, 1.9, 0.8))};
    OcclusionQueryOptions whole;
    whole.finer_levels = 0;
    EXPECT_LT(error_on(room, 0, projected(room, light), light), 2e-3);
    EXPECT_GT(error_on(room, 0, projected(room, light, whole), light), 1e-2);
}

TEST_F(OcclusionQueries, DoNotFlicker) {
    const LitRoom room = closed_room();
    OcclusionQueryOptions coarse;
    coarse.side = 512;
    OcclusionQueryProjection projection(room.space, room.quads, room.occluders, context_->loader(),
                                        coarse);
    const Flicker flicker = flicker_of(room, projection, 20);
    EXPECT_LE(flicker.second_difference, 2e-3);
    EXPECT_LE(flicker.largest_step, 5e-3);
}

TEST_F(OcclusionQueries, LightsAddUp) {
    const LitRoom room = closed_room(0.5);
    const Light first = lamp(Vec3(0.4, 0.5, 1.9)), second = lamp(Vec3(2.5, 3.4, 2.2));
    const RadianceField sum = projected(room, {first}) + projected(room, {second});
    EXPECT_LT((projected(room, {first, second}) - sum).matrix().norm(), 1e-6 * sum.matrix().norm());
}

}  // namespace
}  // namespace lightwell
