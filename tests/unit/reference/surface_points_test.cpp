#include "solver/reference/surface_points.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "solver/reference/sampling.h"
#include "tests/unit/reference/rooms.h"

namespace lightwell {
namespace {

/// A convex quad with no two sides parallel, in a slanted plane.
const Quad crooked{{Vec3(0, 0, 1), Vec3(3, 0, 1), Vec3(2, 2, 2), Vec3(0.5, 1, 1.5)}};

TEST(SurfacePoints, FallOnEachSideByItsArea) {
    std::array<Rgb, 6> grey;
    grey.fill(Rgb::Constant(0.5));
    const Scene scene = box_scene({1, 2, 3}, grey);
    const std::vector<SurfacePoint> points =
        sample_surface(scene, {{x0}, {y0}, {floor_z0}, {ceiling_z1, false}}, 1300, 3);
    ASSERT_EQ(points.size(), 1300U);
    const auto on = [&](int quad) {
        return std::count_if(points.begin(), points.end(),
                             [&](const SurfacePoint& p) { return p.quad == quad; });
    };
    EXPECT_NEAR(double(on(x0)), 600, 1);
    EXPECT_NEAR(double(on(y0)), 300, 1);
    EXPECT_NEAR(double(on(floor_z0)), 200, 1);
    EXPECT_NEAR(double(on(ceiling_z1)), 200, 1);
    EXPECT_EQ(points.front().normal, Vec3::UnitX());
    EXPECT_EQ(points.back().normal, Vec3::UnitZ());
    EXPECT_EQ(sample_surface(scene, {{x0}}, 5, 3)[4].position,
              sample_surface(scene, {{x0}}, 5, 3)[4].position);
    EXPECT_NE(sample_surface(scene, {{x0}}, 5, 3)[4].position,
              sample_surface(scene, {{x0}}, 5, 4)[4].position);
}

// Few points on many quads: the average over seeds is still the share of the area.
TEST(SurfacePoints, ArePlacedWithoutBiasWhereSidesAreManyAndPointsFew) {
    Scene scene;
    for (int k = 0; k < 40; ++k) {
        const double low = k, size = k % 2 == 0 ? 0.5 : 1;
        add_quad(scene,
                 Quad{{Vec3(low, 0, 0), Vec3(low + size, 0, 0), Vec3(low + size, 1, 0),
                       Vec3(low, 1, 0)}},
                 Rgb::Ones());
    }
    std::vector<QuadSide> sides;
    for (int k = 0; k < 40; ++k)
        sides.push_back({k, true});
    std::vector<double> met(40, 0);
    for (std::uint64_t seed = 0; seed < 4000; ++seed)
        for (const SurfacePoint& point : sample_surface(scene, sides, 3, seed))
            ++met[static_cast<std::size_t>(point.quad)];
    for (std::size_t k = 0; k < 40; ++k) {
        const double expected = 4000 * 3 * (k % 2 == 0 ? 0.5 : 1) / 30;
        EXPECT_NEAR(met[k], expected, 4.5 * std::sqrt(expected)) << "quad " << k;
    }
}

TEST(SurfacePoints, CoverACrookedQuadUniformly) {
    Vec3 mean = Vec3::Zero();
    const int n = 64;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Vec3 point = uniform_point_on(crooked, {(i + 0.5) / n, (j + 0.5) / n});
            const Vec2 uv = crooked.parameters(point);
            ASSERT_TRUE((uv.array() > 0).all() && (uv.array() < 1).all());
            mean += point / (n * n);
        }
    // The centroid of two triangles by their areas.
    const auto& v = crooked.vertex;
    const double first = Quad{{v[0], v[1], v[2], v[2]}}.area();
    const double second = Quad{{v[0], v[2], v[3], v[3]}}.area();
    const Vec3 centroid =
        (first * (v[0] + v[1] + v[2]) + second * (v[0] + v[2] + v[3])) / (3 * (first + second));
    EXPECT_LT((mean - centroid).norm(), 0.01);
}

TEST(SurfacePoints, OnlySidesThatReflectAndSeeSomethingCount) {
    std::array<Rgb, 6> walls;
    walls.fill(Rgb::Constant(0.5));
    walls[y1] = Rgb::Zero();
    Scene scene = box_scene({1, 2, 3}, walls);
    add_quad(scene,
             Quad{{Vec3(0.2, 0.2, 1), Vec3(0.8, 0.2, 1), Vec3(0.8, 0.8, 1), Vec3(0.2, 0.8, 1)}},
             Rgb::Constant(0.5));
    const std::vector<QuadSide> sides = seeing_sides(scene, visibility_of(scene));
    ASSERT_EQ(sides.size(), 7U);  // five walls' insides, both sides of the plate
    EXPECT_EQ(sides[6].quad, 6);
    EXPECT_FALSE(sides[6].front);
    EXPECT_THROW(sample_surface(scene, {}, 3, 1), InputError);
}

TEST(EvenPoints, PutOneInEachCellOfEveryShape) {
    RandomStream random(1);
    std::vector<Vec2> points(64);
    draw_even_points(points, random);
    for (const int columns : {1, 4, 8, 64}) {
        std::vector<int> count(64, 0);
        for (const Vec2& p : points)
            ++count[static_cast<std::size_t>(int(p[0] * columns) * (64 / columns) +
                                             int(p[1] * (64 / columns)))];
        EXPECT_EQ(std::count(count.begin(), count.end(), 1), 64) << columns << " columns";
    }
}

TEST(Directions, HaveTheDensityTheyClaim) {
    const Vec3 axis = Vec3(1, -2, 0.5).normalized();
    double cosine_mean = 0, cone_lowest = 1, cone_mean = 0;
    const int n = 128;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Vec2 square((i + 0.5) / n, (j + 0.5) / n);
            cosine_mean += cosine_direction(axis, square).dot(axis) / (n * n);
            const double cosine = cone_direction(axis, 0.25, square).dot(axis);
            cone_mean += cosine / (n * n);
            cone_lowest = std::min(cone_lowest, cosine);
        }
    EXPECT_NEAR(cosine_mean, 2.0 / 3, 1e-4);
    EXPECT_NEAR(cone_mean, 0.625, 1e-9);
    EXPECT_GT(cone_lowest, 0.25);
}

}  // namespace
}  // namespace lightwell
