#include "solver/reference/path_tracer.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "tests/unit/reference/rooms.h"
#include "tests/unit/reference/z_test.h"

namespace lightwell {
namespace {

constexpr double pi = M_PI;

std::array<Rgb, 6> all_walls(double reflectance) {
    std::array<Rgb, 6> result;
    result.fill(Rgb::Constant(reflectance));
    return result;
}

/// Points on the front of one quad at a grid of parameters.
std::vector<SurfacePoint> grid_on(const Scene& scene, int quad, int n) {
    const Quad& shape = scene.quads[static_cast<std::size_t>(quad)].quad;
    std::vector<SurfacePoint> points;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            points.push_back({shape.point((i + 0.5) / n, (j + 0.5) / n), shape.normal(), quad});
    return points;
}

/// Midpoint rule over the parameters of a quad, `n` x `n` cells.
Rgb integral_over(const Quad& quad, int n, const std::function<Rgb(const Vec3&)>& integrand) {
    Rgb sum = Rgb::Zero();
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double u = (i + 0.5) / n, v = (j + 0.5) / n;
            sum += integrand(quad.point(u, v)) * (quad.jacobian(u, v) / (n * n));
        }
    return sum;
}

/// Irradiance at `x` by one reflection at an unshadowed quad: the integral of rho/pi E cos cos /
/// r2.
Rgb one_bounce(const SurfacePoint& x, const Quad& mirror, const Rgb& rho, const Light& light,
               int n) {
    const Vec3 normal = mirror.normal();
    return integral_over(mirror, n, [&](const Vec3& z) -> Rgb {
        const Vec3 to_lamp = position_of(light) - z;
        const double lamp_cosine = normal.dot(to_lamp.normalized());
        const Vec3 to_x = x.position - z;
        const double out = normal.dot(to_x.normalized());
        const double in = -x.normal.dot(to_x.normalized());
        if (lamp_cosine <= 0 || out <= 0 || in <= 0) return Rgb::Zero();
        return rho / pi * intensity_towards(light, -to_lamp.normalized()) * lamp_cosine /
               to_lamp.squaredNorm() * out * in / to_x.squaredNorm();
    });
}

class Furnace : public ::testing::TestWithParam<double> {};

// A closed room whose every surface emits 1 - rho and reflects rho has radiosity, and so
// irradiance, 1 everywhere, of which rho is indirect.
TEST_P(Furnace, IsOneEverywhereAndRhoOfItIndirect) {
    const double rho = GetParam();
    Scene scene = box_scene({3, 4, 2.5}, all_walls(rho));
    add_block(scene, {0.8, 0.9, 0.5}, {1.6, 2.1, 1.4}, Rgb::Constant(rho));
    for (Material& material : scene.materials)
        material.emission = Rgb::Constant((1 - rho) / pi);
    const Visibility visibility = visibility_of(scene);
    const PathTracer tracer(scene, visibility, {});
    const std::vector<SurfacePoint> points =
        sample_surface(scene, {{x0}, {floor_z0}, {6}, {9}, {11}}, 60, 7);

    PathTracing how;
    how.samples = 4096;
    const ZTest total = z_test(tracer.total(points, how).at, {points.size(), Rgb::Ones()});
    EXPECT_TRUE(total.passes()) << total.outside << " of " << total.tested << ", " << total.worst;
    EXPECT_LT(total.largest_noise, 0.025);
    const ZTest indirect =
        z_test(tracer.indirect(points, how).at, {points.size(), Rgb::Constant(rho)});
    EXPECT_TRUE(indirect.passes()) << indirect.outside << ", " << indirect.worst;
    EXPECT_LT(indirect.largest_noise, 0.025);
}

INSTANTIATE_TEST_SUITE_P(Albedos, Furnace, ::testing::Values(0.1, 0.5, 0.9));

class OneBounce : public ::testing::TestWithParam<Light> {};

// One reflecting wall in a black room: the indirect light is one integral over that wall.
TEST_P(OneBounce, IsTheIntegralOverTheOnlyReflectingWall) {
    std::array<Rgb, 6> rho = all_walls(0);
    rho[x1] = Rgb(0.8, 0.5, 0.2);
    const Scene scene = box_scene({3, 2, 2.5}, rho);
    const Visibility visibility = visibility_of(scene);
    const std::vector<SurfacePoint> points = grid_on(scene, floor_z0, 5);
    std::vector<Rgb> exact;
    for (const SurfacePoint& point : points)
        exact.push_back(one_bounce(point, scene.quads[x1].quad, rho[x1], GetParam(), 800));

    PathTracing how;
    how.samples = 4096;
    const PathTracer tracer(scene, visibility, {GetParam()});
    const LightSurvey survey = tracer.indirect(points, how);
    const ZTest test = z_test(survey.at, exact);
    EXPECT_TRUE(test.passes()) << test.outside << " of " << test.tested << ", " << test.worst;
    EXPECT_LT(test.largest_noise, 0.03);
}

INSTANTIATE_TEST_SUITE_P(
    Lights, OneBounce,
    ::testing::Values(
        Light(lamp_at({1.2, 0.8, 1.5})),
        // 3 cm from the wall: without joining both ways of sampling, noise of 50 %
        Light(lamp_at({2.97, 0.8, 1.5})),
        Light(SpotLight{
            "spot", {0.5, 0.5, 1.2}, Rgb(90, 80, 70), Vec3(2, 0.4, 0.3).normalized(), 15, 35})));

// The irradiance below a horizontal emitting rectangle from its corner, closed form.
TEST(PathTracer, LightStraightFromAnEmittingQuadCountsInTheTotalOnly) {
    Scene scene;
    add_quad(scene, Quad{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}},
             Rgb::Constant(0.5));
    add_quad(scene, Quad{{Vec3(0, 0, 1), Vec3(0, 1, 1), Vec3(1, 1, 1), Vec3(1, 0, 1)}}, Rgb::Zero())
        .emission = Rgb(10, 20, 40);
    const Visibility visibility = visibility_of(scene);
    const PathTracer tracer(scene, visibility, {});
    const std::vector<SurfacePoint> corner{{Vec3(0, 0, 0), Vec3::UnitZ(), 0}};
    const double root = std::sqrt(2.0);
    const double view_factor = 2 / (2 * pi) / root * std::atan(1 / root);
    const ZTest test = z_test(tracer.total(corner).at, {Rgb(10, 20, 40) * pi * view_factor});
    EXPECT_TRUE(test.passes()) << test.worst;
    EXPECT_LT(test.largest_noise, 0.01);
    EXPECT_TRUE((tracer.indirect(corner).at[0].mean == 0).all());
}

TEST(PathTracer, LightStraightFromALampIsExactAndShadowed) {
    Scene scene = box_scene({2, 2, 2}, all_walls(0));
    const Light lamp = lamp_at({1, 1, 1.5});
    const std::vector<SurfacePoint> below{{Vec3(1, 1, 0), Vec3::UnitZ(), floor_z0}};
    {
        const Visibility visibility = visibility_of(scene);
        const LightEstimate one = PathTracer(scene, visibility, {lamp}).total(below).at[0];
        EXPECT_NEAR(one.mean[0], 100 / 2.25, 1e-9);
        EXPECT_EQ(one.standard_error[0], 0);
    }
    add_block(scene, {0.9, 0.9, 0.5}, {1.1, 1.1, 0.6}, Rgb::Zero());
    const Visibility visibility = visibility_of(scene);
    EXPECT_EQ(PathTracer(scene, visibility, {lamp}).total(below).at[0].mean[0], 0);
}

// A screen between lamp and sensor, both above it, is seen from behind.
TEST(PathTracer, BacksReflectAndEmitAsTheirMaterialSays) {
    Scene scene;
    Material& screen =
        add_quad(scene, Quad{{Vec3(-1, -1, 0), Vec3(-1, 1, 0), Vec3(1, 1, 0), Vec3(1, -1, 0)}},
                 Rgb::Constant(0.5));
    const Visibility visibility = visibility_of(scene);
    const std::vector<Light> lamp{lamp_at({0, 0, 1})};
    const std::vector<SurfacePoint> sensor{{Vec3(0.1, 0, 0.5), -Vec3::UnitZ(), free_point}};
    const auto indirect = [&] {
        return PathTracer(scene, visibility, lamp).indirect(sensor).at[0].mean[0];
    };
    const auto total_of_emission = [&] {
        return PathTracer(scene, visibility, {}).total(sensor).at[0].mean[0];
    };
    EXPECT_GT(indirect(), 1);
    screen.reflecting = Sides::front;
    EXPECT_EQ(indirect(), 0);
    screen.emission = Rgb::Constant(10);
    EXPECT_EQ(total_of_emission(), 0);
    screen.emitting = Sides::both;
    EXPECT_GT(total_of_emission(), 1);
}

// The judge must be able to say no: the right values pass, the same values 2 % off do not.
TEST(PathTracer, ZTestRejectsAReferenceThatIsTwoPercentOff) {
    std::array<Rgb, 6> rho = all_walls(0);
    rho[x1] = Rgb::Constant(0.8);
    const Scene scene = box_scene({3, 2, 2.5}, rho);
    const Visibility visibility = visibility_of(scene);
    const Light lamp = lamp_at({1.2, 0.8, 1.5});
    const std::vector<SurfacePoint> points = grid_on(scene, floor_z0, 4);
    PathTracing how;
    how.samples = 16384;
    const LightSurvey survey = PathTracer(scene, visibility, {lamp}).indirect(points, how);
    std::vector<Rgb> right, wrong;
    for (const SurfacePoint& point : points) {
        right.push_back(one_bounce(point, scene.quads[x1].quad, rho[x1], lamp, 800));
        wrong.push_back(1.02 * right.back());
    }
    EXPECT_TRUE(z_test(survey.at, right).passes());
    EXPECT_FALSE(z_test(survey.at, wrong).passes());
}

TEST(PathTracer, ResultsDoNotDependOnThreads) {
    Scene scene = box_scene({3, 2, 2.5}, all_walls(0.6));
    scene.materials[ceiling_z1].emission = Rgb(1, 2, 3);
    const Visibility visibility = visibility_of(scene);
    const PathTracer tracer(scene, visibility, {lamp_at({1, 1, 1}), lamp_at({2, 1, 1})});
    const std::vector<SurfacePoint> points = grid_on(scene, floor_z0, 4);
    PathTracing how;
    how.samples = 64;
    const auto with_threads = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return tracer.total(points, how);
    };
    const LightSurvey one = with_threads(1), two = with_threads(2);
    EXPECT_EQ(one.rays, two.rays);
    for (std::size_t k = 0; k < points.size(); ++k) {
        EXPECT_TRUE((one.at[k].mean == two.at[k].mean).all());
        EXPECT_TRUE((one.at[k].standard_error == two.at[k].standard_error).all());
    }
}

TEST(PathTracer, ReachesTheNoiseItIsAskedFor) {
    const Scene scene = box_scene({3, 2, 2.5}, all_walls(0.5));
    const Visibility visibility = visibility_of(scene);
    const PathTracer tracer(scene, visibility, {lamp_at({1.2, 0.8, 2.4})});
    PathTracing how;
    how.samples = 256;
    const LightSurvey survey = tracer.indirect_to({0.01}, grid_on(scene, floor_z0, 4), how);
    int noisy = 0;
    for (const LightEstimate& one : survey.at)
        if (one.standard_error[0] > 0.013 * one.mean[0]) ++noisy;
    EXPECT_LE(noisy, 1);
    EXPECT_GT(survey.rays, survey.paths);
}

}  // namespace
}  // namespace lightwell
