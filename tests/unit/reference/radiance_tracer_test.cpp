#include "solver/reference/radiance_tracer.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "radiance4d/basis/direction_map.h"
#include "radiance4d/scene/brdf.h"
#include "tests/unit/reference/rooms.h"
#include "tests/unit/reference/z_test.h"

namespace lightwell {
namespace {

std::array<Rgb, 6> all_walls(double reflectance) {
    std::array<Rgb, 6> result;
    result.fill(Rgb::Constant(reflectance));
    return result;
}

/// Probes from a point into `count` even directions.
std::vector<RadianceProbe> probes_from(const Vec3& position, int count) {
    std::vector<RadianceProbe> probes;
    for (int k = 0; k < count; ++k)
        probes.push_back({position, spiral_direction(k, count)});
    return probes;
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

PathTracing samples(int count) {
    PathTracing how;
    how.samples = count;
    return how;
}

class GlossyFurnace : public ::testing::TestWithParam<Lobe> {};

// Every surface emits 1 - a(w) of 1, so radiance is 1 everywhere and in every direction.
TEST_P(GlossyFurnace, HasRadianceOneEverywhere) {
    Scene scene = box_scene({3, 4, 2.5}, all_walls(0.15));
    add_block(scene, {0.8, 0.9, 0.5}, {1.6, 2.1, 1.4}, Rgb::Constant(0.15));
    scene.materials.resize(1);
    scene.materials[0].lobe = GetParam();
    scene.materials[0].emission = Rgb::Ones();
    for (SceneQuad& quad : scene.quads)
        quad.material = 0;
    const Visibility visibility = visibility_of(scene);
    const RadianceTracer tracer(scene, visibility, {}, EmissionLaw::furnace);
    const std::vector<RadianceProbe> probes = probes_from({2.2, 2.4, 1.1}, 48);
    const LightSurvey survey = tracer.total(probes, samples(3072));
    const ZTest test = z_test(survey.at, {probes.size(), Rgb::Ones()});
    EXPECT_TRUE(test.passes()) << test.outside << " of " << test.tested << ", " << test.worst;
    EXPECT_LT(test.largest_noise, 0.03);
    // All together, far sharper: a common bias would show.
    double mean = 0, variance = 0;
    for (const LightEstimate& one : survey.at) {
        mean += one.mean[0] / static_cast<double>(probes.size());
        variance += std::pow(one.standard_error[0] / static_cast<double>(probes.size()), 2);
    }
    EXPECT_NEAR(mean, 1, 4 * std::sqrt(variance));
    EXPECT_LT(std::sqrt(variance), 0.002);
}

INSTANTIATE_TEST_SUITE_P(Lobes, GlossyFurnace,
                         ::testing::Values(Lobe(PhongLobe{Rgb(0.8, 0.4, 0.1), 1}),
                                           Lobe(PhongLobe{Rgb(0.8, 0.4, 0.1), 10}),
                                           Lobe(PhongLobe{Rgb(0.8, 0.4, 0.1), 50}),
                                           Lobe(PhongLobe{Rgb(0.8, 0.4, 0.1), 200}),
                                           Lobe(GgxLobe{Rgb(0.8, 0.4, 0.1), 0.15}),
                                           Lobe(GgxLobe{Rgb(0.8, 0.4, 0.1), 0.5}),
                                           Lobe(GgxLobe{Rgb(0.8, 0.4, 0.1), 1})));

// In diffuse scenes it must agree with the tracer that knows nothing of lobes.
TEST(RadianceTracer, AgreesWithThePathTracerOnDiffuseScenes) {
    Scene scene = box_scene({3, 2, 2.5}, all_walls(0.5));
    add_block(scene, {0.8, 0.5, 0.3}, {1.6, 1.1, 1.4}, Rgb(0.2, 0.5, 0.7));
    scene.materials[ceiling_z1].emission = Rgb(20, 15, 5);
    const Visibility visibility = visibility_of(scene);
    const std::vector<Light> lamp{lamp_at({2.2, 0.8, 1.5})};
    const std::vector<SurfacePoint> points = grid_on(scene, floor_z0, 4);
    const PathTracing how = samples(8192);
    const LightSurvey plain = PathTracer(scene, visibility, lamp).indirect(points, how);
    const LightSurvey general =
        RadianceTracer(scene, visibility, lamp).indirect_irradiance(points, how);
    for (std::size_t k = 0; k < points.size(); ++k)
        for (int c = 0; c < 3; ++c) {
            const double noise =
                std::hypot(plain.at[k].standard_error[c], general.at[k].standard_error[c]);
            EXPECT_NEAR(general.at[k].mean[c], plain.at[k].mean[c], 4.5 * noise);
            EXPECT_LT(noise, 0.02 * plain.at[k].mean[c]);
        }
    // A diffuse surface looks alike from all sides: rho/pi times its irradiance.
    const Vec3 seen = points[15].position;
    std::vector<RadianceProbe> probes;
    for (const Vec3& eye : {Vec3(2.5, 1.5, 2), Vec3(0.2, 1.8, 1), Vec3(1.5, 0.2, 2.4)})
        probes.push_back({eye, (seen - eye).normalized()});
    const LightSurvey radiance = RadianceTracer(scene, visibility, lamp).indirect(probes, how);
    for (const LightEstimate& one : radiance.at)
        EXPECT_NEAR(
            one.mean[0], 0.5 / M_PI * plain.at[15].mean[0],
            4.5 * std::hypot(one.standard_error[0], 0.5 / M_PI * plain.at[15].standard_error[0]));
}

// A lamp close to a polished floor makes paths that differ by far more than the number of paths
// says.
TEST(RadianceTracer, KeepsToANoise) {
    Scene scene = box_scene({3, 2, 2.5}, all_walls(0.5));
    scene.materials[floor_z0].reflectance = Rgb::Constant(0.1);
    scene.materials[floor_z0].lobe = PhongLobe{Rgb::Constant(0.6), 40};
    const Visibility visibility = visibility_of(scene);
    const RadianceTracer tracer(scene, visibility, {lamp_at({0.4, 0.5, 0.2})});
    const std::vector<SurfacePoint> points = grid_on(scene, x0, 5);
    NoiseTarget target;
    target.floor = 1;
    for (const double relative : {0.1, 0.02}) {
        target.relative = relative;
        const LightSurvey survey = tracer.indirect_irradiance_to(target, points, samples(128));
        double squares = 0, noise = 0;
        for (const LightEstimate& one : survey.at) {
            squares += std::pow(luminance(one.mean), 2);
            noise += std::pow(luminance(one.standard_error), 2);
        }
        EXPECT_LT(std::sqrt(noise / squares), 1.1 * relative);
        // Not by more paths than it takes: a third more were asked for, and most points are darker
        // than the measure.
        EXPECT_GT(std::sqrt(noise / squares), 0.3 * relative);
        EXPECT_GT(survey.paths, 0);
    }
}

class OneGlossyWall : public ::testing::TestWithParam<Lobe> {
  protected:
    void SetUp() override {
        scene = box_scene({3, 2, 2.5}, all_walls(0));
        scene.materials[x1].reflectance = Rgb(0.3, 0.2, 0.1);
        scene.materials[x1].lobe = GetParam();
    }
    const Quad& wall() const { return scene.quads[x1].quad; }
    /// The wall's BRDF between world directions.
    Rgb f(const Vec3& a, const Vec3& b) const {
        const Eigen::Matrix3d frame = local_frame(wall());
        return brdf(scene.materials[x1], frame.transpose() * a, frame.transpose() * b);
    }

    Scene scene;
    const PointLight lamp = lamp_at({1.2, 0.8, 1.5});
};

// The reflection of a lamp: f I cos / r^2, without noise.
TEST_P(OneGlossyWall, ReflectsALampAsItsBrdfSays) {
    const Visibility visibility = visibility_of(scene);
    const RadianceTracer tracer(scene, visibility, {lamp});
    const Vec3 eye(0.5, 1.2, 0.7);
    for (const Vec3& seen : {Vec3(3, 0.9, 1.2), Vec3(3, 0.2, 2), Vec3(3, 1.7, 0.4)}) {
        const Vec3 direction = (seen - eye).normalized();
        const Vec3 to_lamp = (lamp.position - seen).normalized();
        const Rgb exact = f(-direction, to_lamp) * lamp.intensity * wall().normal().dot(to_lamp) /
                          (lamp.position - seen).squaredNorm();
        const LightEstimate one = tracer.total({{eye, direction}}, samples(64)).at[0];
        EXPECT_NEAR((one.mean - exact).abs().maxCoeff(), 0, 1e-5 * exact.maxCoeff());
        EXPECT_LT(one.standard_error.maxCoeff(), 1e-9);
        EXPECT_EQ(tracer.indirect({{eye, direction}}, samples(64)).at[0].mean[0], 0);
    }
}

// The irradiance on a black floor is one integral over the wall.
TEST_P(OneGlossyWall, LightsTheFloorAsTheIntegralSays) {
    const Visibility visibility = visibility_of(scene);
    const std::vector<SurfacePoint> points = grid_on(scene, floor_z0, 4);
    constexpr int n = 400;
    std::vector<Rgb> exact;
    for (const SurfacePoint& x : points) {
        Rgb sum = Rgb::Zero();
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const Vec3 z = wall().point((i + 0.5) / n, (j + 0.5) / n);
                const Vec3 to_lamp = lamp.position - z, to_x = x.position - z;
                const Vec3 towards = to_x.normalized();
                const double per_area = wall().area() / (n * n);
                sum += f(to_lamp.normalized(), towards) * lamp.intensity *
                       wall().normal().dot(to_lamp.normalized()) / to_lamp.squaredNorm() *
                       wall().normal().dot(towards) * -x.normal.dot(towards) / to_x.squaredNorm() *
                       per_area;
            }
        exact.push_back(sum);
    }
    const LightSurvey survey =
        RadianceTracer(scene, visibility, {lamp}).indirect_irradiance(points, samples(8192));
    const ZTest test = z_test(survey.at, exact);
    EXPECT_TRUE(test.passes()) << test.outside << " of " << test.tested << ", " << test.worst;
    EXPECT_LT(test.largest_noise, 0.06);
}

INSTANTIATE_TEST_SUITE_P(Lobes, OneGlossyWall,
                         ::testing::Values(Lobe(PhongLobe{Rgb(0.5, 0.6, 0.2), 5}),
                                           Lobe(PhongLobe{Rgb(0.5, 0.6, 0.2), 40}),
                                           Lobe(GgxLobe{Rgb(0.5, 0.6, 0.2), 0.3})));

// The judge must be able to say no.
TEST(RadianceTracer, TheFurnaceRejectsAnAlbedoThatIsOnePercentOff) {
    Scene scene = box_scene({3, 4, 2.5}, all_walls(0.15));
    for (Material& material : scene.materials) {
        material.lobe = PhongLobe{Rgb::Constant(0.6), 20};
        material.emission = Rgb::Constant(1.01);
    }
    const Visibility visibility = visibility_of(scene);
    const RadianceTracer tracer(scene, visibility, {}, EmissionLaw::furnace);
    const std::vector<RadianceProbe> probes = probes_from({2.2, 2.4, 1.1}, 12);
    EXPECT_FALSE(z_test(tracer.total(probes, samples(16384)).at, {12, Rgb::Ones()}).passes());
}

TEST(RadianceTracer, SeesWhatASurfaceEmitsAndNothingInTheOpen) {
    Scene scene;
    add_quad(scene, Quad{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}}, Rgb::Zero())
        .emission = Rgb(1, 2, 3);
    const Visibility visibility = visibility_of(scene);
    const RadianceTracer tracer(scene, visibility, {});
    const LightSurvey survey = tracer.total({{Vec3(0.5, 0.5, 2), -Vec3::UnitZ()},
                                             {Vec3(0.5, 0.5, 2), Vec3::UnitZ()},
                                             {Vec3(0.5, 0.5, -2), Vec3::UnitZ()}},
                                            samples(64));
    EXPECT_TRUE((survey.at[0].mean == Rgb(1, 2, 3)).all());
    EXPECT_TRUE((survey.at[1].mean == 0).all());
    EXPECT_TRUE((survey.at[2].mean == 0).all());  // the back does not emit
}

TEST(RadianceTracer, ResultsDoNotDependOnThreads) {
    Scene scene = box_scene({3, 2, 2.5}, all_walls(0.3));
    scene.materials[floor_z0].lobe = GgxLobe{Rgb::Constant(0.5), 0.2};
    scene.materials[ceiling_z1].emission = Rgb(1, 2, 3);
    const Visibility visibility = visibility_of(scene);
    const RadianceTracer tracer(scene, visibility, {lamp_at({1, 1, 1}), lamp_at({2, 1, 1})});
    const std::vector<RadianceProbe> probes = probes_from({1.5, 1, 1.2}, 16);
    const auto with_threads = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return tracer.total(probes, samples(64));
    };
    const LightSurvey one = with_threads(1), two = with_threads(2);
    EXPECT_EQ(one.rays, two.rays);
    for (std::size_t k = 0; k < probes.size(); ++k)
        EXPECT_TRUE((one.at[k].mean == two.at[k].mean).all());
}

}  // namespace
}  // namespace lightwell
