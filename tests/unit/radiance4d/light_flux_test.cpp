#include "radiance4d/scene/light_flux.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "radiance4d/scene/form_factor.h"
#include "tests/shared_reference.h"
#include "tests/unit/radiance4d/rooms.h"

namespace lightwell {
namespace {

SpotLight spot(const Vec3& position, const Vec3& direction, double inner, double outer) {
    return {"spot", position, Rgb(1, 2, 0.5), direction.normalized(), inner, outer};
}

/// The red flux of a spot in all directions, by the midpoint rule over the cosine.
double total_by_integration(const SpotLight& light) {
    const int steps = 200000;
    const Vec3 side = light.direction.unitOrthogonal();
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double c = -1 + 2 * (i + 0.5) / steps;
        const Vec3 direction = c * light.direction + std::sqrt(1 - c * c) * side;
        sum += intensity_towards(light, direction)[0];
    }
    return 2 * M_PI * sum * 2 / steps;
}

double into_box(const Light& light, const std::vector<Quad>& walls) {
    double sum = 0;
    for (const Quad& wall : walls)
        sum += flux(light, ConvexPolygon(wall))[0];
    return sum;
}

TEST(LightFlux, AClosedBoxReceivesAllOfAPointLight) {
    for (const double s : {1e-3, 1.0, 1e3}) {
        const std::vector<Quad> walls = box_walls(Vec3::Zero(), s * Vec3(4, 5, 3));
        for (const Vec3& place :
             {Vec3(2, 2.5, 1.5), Vec3(0.001, 2, 1), Vec3(1, 4.999, 2.999),
              Vec3(0.001, 0.001, 0.001), Vec3(3.999999, 1, 1), Vec3(1, 1, 3 - 1e-9)}) {
            const PointLight lamp{"lamp", s * place, Rgb(100, 10, 1)};
            EXPECT_NEAR(into_box(lamp, walls), 400 * M_PI, 400 * M_PI * 1e-12) << place.transpose();
        }
    }
}

TEST(LightFlux, Cie171Case54FluxConservation) {
    LIGHTWELL_SHARED_JSON(cases, "reference/cie171.json");
    const auto& test = cases["5.4_flux_conservation"]["flux_lm"];
    const std::vector<Quad> walls = box_walls(Vec3::Zero(), Vec3(4, 4, 3));
    const PointLight lamp{"lamp", Vec3(2, 2, 1.5), Rgb::Constant(10000 / (4 * M_PI))};
    const char* names[] = {"wall_x0", "wall_x4", "wall_y0", "wall_y4", "floor", "ceiling"};
    for (std::size_t w = 0; w < 6; ++w) {
        const double expected = test[names[w]];
        EXPECT_NEAR(flux(lamp, ConvexPolygon(walls[w]))[1], expected, 1e-12 * expected) << names[w];
    }
}

TEST(LightFlux, AClosedBoxReceivesAllOfASpot) {
    const std::vector<Quad> walls = box_walls(Vec3::Zero(), Vec3(4, 5, 3));
    std::mt19937 random(29);
    for (const auto& [inner, outer] :
         {std::pair{0.0, 10.0}, std::pair{0.0, 180.0}, std::pair{20.0, 30.0},
          std::pair{20.0, 20.001}, std::pair{30.0, 30.0}, std::pair{60.0, 120.0},
          std::pair{100.0, 170.0}, std::pair{180.0, 180.0}}) {
        const double radian = M_PI / 180;
        const double width = std::cos(inner * radian) - std::cos(outer * radian);
        const double closed_form = 2 * M_PI * (1 - std::cos(inner * radian) + 0.5 * width);
        ASSERT_NEAR(total_by_integration(spot(Vec3::Zero(), Vec3::UnitX(), inner, outer)),
                    closed_form, 1e-4);
        for (int k = 0; k < 40; ++k) {
            Vec3 direction = random_direction(random);
            if (k < 3) direction = Vec3::Unit(k);
            if (k == 3) direction = Vec3(-1, -1, 0);
            if (k == 4) direction = Vec3(2, 2.5, 1.5);
            const Vec3 place =
                k < 10 ? Vec3(2, 2.5, 1.5) : Vec3(random_point(random).cwiseProduct(Vec3(4, 5, 3)));
            const SpotLight light = spot(place, direction, inner, outer);
            ASSERT_NEAR(into_box(light, walls), closed_form, 1e-11)
                << inner << " " << outer << " towards " << direction.transpose();
        }
    }
}

// The flux through a polygon against the plain sum of its small parts, each with the intensity at
// its centre; whatever the side, also with the cone's edge across it.
TEST(LightFlux, SpotThroughAPolygonMatchesASumOverSmallParts) {
    std::mt19937 random(31);
    for (int k = 0; k < 40; ++k) {
        const Quad quad = random_parallelogram(random, 1.5);
        // Not so close that the small parts are large to the light.
        const Vec3 away = (0.5 + 0.02 * k) * quad.normal() + 0.4 * random_direction(random);
        const SpotLight light =
            spot(quad.centre() + away, 0.5 * random_direction(random) - away, 5 + k, 25 + 3 * k);
        const int n = 160;
        double sum = 0;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const Quad part = quad.part(static_cast<double>(i) / n, (i + 1.0) / n,
                                            static_cast<double>(j) / n, (j + 1.0) / n);
                const Vec3 direction = (part.centre() - light.position).normalized();
                sum += intensity_towards(light, direction)[1] *
                       solid_angle(light.position, ConvexPolygon(part));
            }
        EXPECT_NEAR(flux(light, ConvexPolygon(quad))[1], sum, 2e-4 * std::max(sum, 0.1)) << k;
        EXPECT_NEAR(flux(light, ConvexPolygon(quad.reversed()))[1],
                    flux(light, ConvexPolygon(quad))[1], 1e-12);
    }
}

TEST(LightFlux, PartsAddUpToTheWhole) {
    std::mt19937 random(37);
    for (int k = 0; k < 500; ++k) {
        const ConvexPolygon whole(random_parallelogram(random, 1.5));
        const SpotLight light = spot(random_point(random), random_direction(random), 20, 70);
        const Vec3 n = random_direction(random);
        const CutPolygon parts = cut(whole, Plane{n, n.dot(whole.centre())});
        const Rgb sum = flux(light, std::vector<ConvexPolygon>{parts.inside, parts.outside});
        ASSERT_LT((sum - flux(light, whole)).abs().maxCoeff(), 1e-11);
    }
}

TEST(LightFlux, HardConesOfTheReference) {
    LIGHTWELL_SHARED_JSON(cases, "reference/direct_tests.json");
    int compared = 0;
    const double far = 1e7;
    const ConvexPolygon floor(level_rectangle(-far, far, -far, far, 0));
    for (const auto& entry : cases["spot"]) {
        // Ours have no cos^n law; n = 0 is a cone with a hard edge.
        if (entry["n"] != 0) continue;
        const double half_angle = entry["half_angle_deg"], expected = entry["flux_per_I0"];
        const SpotLight light = spot(Vec3(0, 0, 2), -Vec3::UnitZ(), half_angle, half_angle);
        EXPECT_NEAR(flux(light, floor)[0], expected, 1e-6 * expected) << half_angle;
        ++compared;
    }
    EXPECT_GE(compared, 4);
}

TEST(LightFlux, GrazingLightsOfTheReference) {
    LIGHTWELL_SHARED_JSON(cases, "reference/direct_tests.json");
    for (const auto& entry : cases["grazing_point_light"]) {
        const double h = entry["h"], r = entry["r"], expected = entry["E_mean_1x1"];
        const PointLight lamp{"lamp", Vec3(0, 0, h), Rgb::Ones()};
        const ConvexPolygon patch(level_rectangle(r - 0.5, r + 0.5, -0.5, 0.5, 0));
        EXPECT_NEAR(flux(lamp, patch)[0], expected, 1e-10 * expected) << h << " " << r;
    }
}

TEST(LightFlux, NothingThroughAPolygonSeenEdgeOn) {
    const ConvexPolygon level(level_rectangle(-1, 1, -1, 1, 0));
    for (const Vec3& place : {Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(5, 0, 0)}) {
        EXPECT_EQ(flux(PointLight{"", place, Rgb::Ones()}, level)[0], 0);
        EXPECT_EQ(flux(spot(place, Vec3(1, 0, -1), 40, 80), level)[0], 0);
    }
}

}  // namespace
}  // namespace lightwell
