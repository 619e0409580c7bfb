// A room with a glossy floor, through operator and BRDF, against the path tracer.

#include <cmath>

#include <gtest/gtest.h>

#include "radiance4d/operator/light_projection.h"
#include "radiance4d/operator/reflection.h"
#include "runtime/outgoing/brdf_product.h"
#include "solver/radiance_bounce.h"
#include "solver/reference/radiance_tracer.h"
#include "tests/unit/reference/rooms.h"

namespace lightwell {
namespace {

/// A box with a glossy floor on which a block stands.
class GlossyRoom : public ::testing::TestWithParam<Lobe> {
  protected:
    void SetUp() override {
        std::array<Rgb, 6> rho;
        rho.fill(Rgb::Constant(0.5));
        rho[x0] = Rgb(0.63, 0.06, 0.05);
        rho[x1] = Rgb(0.14, 0.45, 0.09);
        rho[floor_z0] = Rgb::Constant(0.1);
        scene = box_scene({3, 2, 2.5}, rho);
        add_block(scene, {0.75, 0.8, 0.0}, {1.5, 1.4, 1.0}, Rgb(0.2, 0.3, 0.7));
        for (Material& material : scene.materials)
            material.reflecting = Sides::front;
        scene.materials[floor_z0].lobe = GetParam();
    }

    Scene scene;
    const PointLight lamp = lamp_at({2.3, 1.0, 1.8});
};

// What an eye sees of the floor, in blocks of the basis and without smoothing, at three eye points.
TEST_P(GlossyRoom, LooksAsThePathTracerSays) {
    OracleCost cost;
    const Ground ground(scene, cost);
    const RadianceBounce bounce = radiance_bounce(ground, {});
    const RadianceSpace& space = bounce.space;
    const Reflection reflection(scene, space);
    const RadianceField bounced =
        bounced_light(bounce.propagation, reflection,
                      projected_lights(space, {lamp}, ground.quads, ground.occluders));
    const BrdfProduct product(scene, space, bounced);
    const auto floor = static_cast<std::size_t>(space.element_on(floor_z0, true));
    const RadianceTracer tracer(scene, ground.visibility, {lamp});
    PathTracing how;
    how.samples = 512;
    double off = 0, noise = 0, squares = 0, seen_sum = 0, exact_sum = 0;
    for (const Vec3& eye : {Vec3(0.3, 1.0, 1.6), Vec3(2.7, 0.3, 1.2), Vec3(1.5, 1.8, 2.2)}) {
        std::vector<RadianceProbe> probes;
        std::vector<double> seen;
        for (int i = 0; i < 12; ++i)
            for (int j = 0; j < 8; ++j) {
                const Vec3 at((i + 0.37) / 12 * 3, (j + 0.41) / 8 * 2, 0);
                const Vec3 direction = (at - eye).normalized();
                if (ground.visibility.nearest(eye, free_point, direction).quad != floor_z0)
                    continue;
                probes.push_back({eye, direction});
                const Vec2 uv = space.element(floor).geometry.parameters(at);
                seen.push_back(luminance(product.radiance(floor, uv, -direction)));
            }
        const LightSurvey survey = tracer.indirect(probes, how);
        for (std::size_t k = 0; k < probes.size(); ++k) {
            const double exact = luminance(survey.at[k].mean);
            off += std::pow(seen[k] - exact, 2);
            noise += std::pow(luminance(survey.at[k].standard_error), 2);
            squares += exact * exact;
            seen_sum += seen[k];
            exact_sum += exact;
        }
    }
    EXPECT_LT(std::sqrt(std::max(0.0, off - noise) / squares), 0.06);
    EXPECT_LT(std::sqrt(noise / squares), 0.03);
    EXPECT_NEAR(seen_sum / exact_sum, 1, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Lobes, GlossyRoom,
                         ::testing::Values(Lobe(PhongLobe{Rgb::Constant(0.7), 5}),
                                           Lobe(PhongLobe{Rgb::Constant(0.7), 10}),
                                           Lobe(GgxLobe{Rgb::Constant(0.7), 0.3})));

}  // namespace
}  // namespace lightwell
