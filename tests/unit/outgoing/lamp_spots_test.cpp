#include "runtime/outgoing/lamp_spots.h"

#include <cmath>

#include <gtest/gtest.h>

#include "radiance4d/basis/direction_map.h"
#include "radiance4d/operator/smooth_irradiance.h"
#include "radiance4d/scene/brdf.h"
#include "radiance4d/scene/scene_quads.h"
#include "runtime/outgoing/final_gather.h"

namespace lightwell {
namespace {

/// A polished floor and, 1 m over it, a ceiling. No light but a lamp's gets anywhere.
GlobalTransport floor_and_ceiling(const Lobe& on_the_ceiling) {
    GlobalTransport transport;
    Material above, below;
    above.reflectance = Rgb::Constant(0.4);
    above.lobe = on_the_ceiling;
    below.lobe = PhongLobe{Rgb::Constant(0.5), 20};
    transport.scene.materials = {above, below};
    transport.scene.quads = {
        {{{Vec3(-1, -1, 1), Vec3(-1, 1, 1), Vec3(1, 1, 1), Vec3(1, -1, 1)}}, 0, 0, 0},
        {{{Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)}}, 1, 1, 0}};
    std::vector<Element> elements(2);
    for (int q = 0; q < 2; ++q) {
        Element& element = elements[static_cast<std::size_t>(q)];
        element.quad = q;
        element.front = true;
        element.geometry = transport.scene.quads[static_cast<std::size_t>(q)].quad;
        element.set_space(CellTree(), {});
        if (is_glossy(transport.scene.material_of(q))) element.angle = angular_basis(1).tree();
    }
    transport.space = RadianceSpace(elements);
    transport.bounce.upper.size = transport.space.functions();
    transport.bounce.upper.column_start.assign(transport.space.functions() + 1, 0);
    return transport;
}

/// A lamp 2 cm below the ceiling: what it lights there is a thousandth of the sky of the floor.
class SpotOnTheCeiling : public ::testing::TestWithParam<Lobe> {
  protected:
    /// Light of the lamp by way of the ceiling, at a point of the floor that makes `received` of a
    /// radiance from a direction: summed over directions of the lamp, which sees no small spot.
    template <typename Received>
    double exact(const Vec3& point, const Received& received) const {
        constexpr int steps = 800;
        const Vec3 lamp = position_of(lamps[0]);
        const Eigen::Matrix3d frame = local_frame(transport.scene.quads[0].quad).transpose();
        double sum = 0;
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < steps; ++j) {
                const double z = (i + 0.5) / steps, turn = 2 * M_PI * (j + 0.5) / steps;
                const double across = std::sqrt(1 - z * z);
                const Vec3 ray(across * std::cos(turn), across * std::sin(turn), z);
                const Vec3 lit = lamp + (1 - lamp[2]) / z * ray;
                if (std::abs(lit[0]) > 1 || std::abs(lit[1]) > 1) continue;
                const Vec3 way = lit - point;
                const Vec3 direction = way.normalized();
                sum += received(direction) * direction[2] / way.squaredNorm() *
                       brdf(transport.scene.materials[0], frame * -ray, frame * -direction)[0];
            }
        return candela * sum * 2 * M_PI / (double{steps} * steps);
    }

    static constexpr double candela = 10;
    const std::vector<Light> lamps = {PointLight{"", {0.1, 0.2, 0.98}, Rgb::Constant(candela)}};
    const GlobalTransport transport = floor_and_ceiling(GetParam());
    const std::vector<Quad> quads = quads_of(transport.scene);
    const Visibility visibility{quads};
    const OccluderTree occluders{quads};
    const DirectLight direct{transport.scene, visibility, occluders};
    const RadianceField dark = RadianceField::Zero(transport.space.functions(), 3);
    const GlossyLight glossy{transport, direct, lamps, {dark, dark}};
    const FinalGather gather{transport, visibility, smooth_irradiance(transport.space, dark),
                             24,        &glossy,    {&direct, {{lamps[0], {0}}}}};
};

TEST_P(SpotOnTheCeiling, LightsEveryPointAlike) {
    // The last one is as near to the spot as the lamp is, and sees it large.
    for (const Vec3& point : {Vec3(0, 0, 0), Vec3(0.13, 0.17, 0), Vec3(-0.6, 0.3, 0),
                              Vec3(0.9, -0.9, 0), Vec3(0.12, 0.2, 0.97)}) {
        const double wanted = exact(point, [](const Vec3& direction) { return direction[2]; });
        EXPECT_NEAR(gather.irradiance(point, Vec3::UnitZ(), point[2] > 0 ? free_point : 1)[1],
                    wanted, 0.015 * wanted)
            << point.transpose();
    }
}

TEST_P(SpotOnTheCeiling, IsMirroredAlike) {
    const Vec3 eye(0.7, -0.5, 0.5);
    const Lobe& lobe = transport.scene.materials[1].lobe;
    // In the middle of the highlight and off it.
    for (const Vec3& point : {Vec3(0.5, -0.26, 0), Vec3(0.4, -0.1, 0), Vec3(0.5, -0.5, 0)}) {
        const Vec3 towards = (eye - point).normalized();
        const double wanted = 0.5 * exact(point, [&](const Vec3& direction) {
                                  return direction[2] * lobe_value(lobe, direction, towards);
                              });
        EXPECT_NEAR(gather.from_lobe(1, point, towards).indirect[1], wanted, 0.015 * wanted)
            << point.transpose();
    }
}

INSTANTIATE_TEST_SUITE_P(Ceilings, SpotOnTheCeiling,
                         ::testing::Values(Lobe(NoLobe{}), Lobe(PhongLobe{Rgb::Constant(0.3), 5})));

}  // namespace
}  // namespace lightwell
