#include "runtime/outgoing/brdf_product.h"

#include <cmath>

#include <gtest/gtest.h>

#include "radiance4d/basis/angular_reflection.h"
#include "radiance4d/basis/direction_map.h"
#include "radiance4d/scene/brdf.h"

namespace lightwell {
namespace {

/// One glossy square.
class GlossySquare : public ::testing::Test {
  protected:
    void build(const Lobe& lobe, int levels) {
        scene.materials.resize(1);
        scene.materials[0].reflectance = Rgb(0.1, 0.2, 0.3);
        scene.materials[0].lobe = lobe;
        const Quad square{{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 2, 0), Vec3(0, 2, 0)}};
        scene.quads = {{square, 0, 0, 0}};
        Element element;
        element.geometry = square;
        element.space = HaarBasis(square, CellTree({Split::both}));
        element.angle = angular_basis(levels).tree();
        space = RadianceSpace({element});
    }

    Scene scene;
    RadianceSpace space;
};

class UniformLight : public GlossySquare, public ::testing::WithParamInterface<Lobe> {};

// Of uniform radiance 1 the surface gives back a(theta): the glossy furnace seen by an eye.
TEST_P(UniformLight, GivesTheDirectionalAlbedo) {
    build(GetParam(), 3);
    RadianceField one = RadianceField::Zero(space.functions(), 3);
    one.row(0) = std::sqrt(4.0);
    const BrdfProduct product(scene, space, one);
    for (const double degrees : {0.0, 30.0, 60.0, 75.0}) {
        const double theta = degrees * M_PI / 180;
        const Vec3 direction(std::sin(theta), 0, std::cos(theta));
        const Rgb exact = albedo(scene.materials[0], direction[2]);
        const Rgb seen = product.radiance(0, Vec2(0.3, 0.8), direction);
        EXPECT_LT(((seen - exact) / exact).abs().maxCoeff(), 0.005) << degrees;
    }
    EXPECT_EQ(product.radiance(0, 0, Vec3(0.6, 0, -0.8))[0], 0);
}

INSTANTIATE_TEST_SUITE_P(Lobes, UniformLight,
                         ::testing::Values(Lobe(PhongLobe{Rgb(0.7, 0.5, 0.2), 5}),
                                           Lobe(PhongLobe{Rgb(0.7, 0.5, 0.2), 30}),
                                           Lobe(GgxLobe{Rgb(0.7, 0.5, 0.2), 0.5})));

// Light through one angular cell on one quarter of the square.
TEST_F(GlossySquare, ReflectsLightFromOneCellByItsBrdf) {
    build(PhongLobe{Rgb(0.7, 0.5, 0.2), 10}, 3);
    const HaarBasis angular = angular_basis(3);
    const std::uint32_t lit_angle = 37;
    RowMatrix by_angle = RowMatrix::Zero(64, 4);
    by_angle(lit_angle, 2) = 5 * std::sqrt(1.0 / 64);  // radiance 5 on a cell of 1 m2
    angular.analyse(by_angle, 3);
    RowMatrix by_cell = by_angle.transpose();
    space.element(0).space.analyse(by_cell, 1);
    RadianceField field(space.functions(), 3);
    field.colwise() = Eigen::Map<const Eigen::ArrayXd>(by_cell.data(), space.functions());

    const BrdfProduct product(scene, space, field);
    const Vec3 eye = Vec3(-0.2, 0.4, 0.7).normalized();
    const ParameterRect r = angular.tree().rect({3, lit_angle});
    Rgb exact = Rgb::Zero();
    constexpr int n = 40;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Vec3 in =
                direction_from_square({r.u0 + (i + .5) / n / 8, r.v0 + (j + .5) / n / 8});
            exact += 5 * M_PI / 64 / (n * n) * brdf(scene.materials[0], in, eye);
        }
    const Rgb seen = product.radiance(0, Vec2(0.25, 0.75), eye);
    EXPECT_LT(((seen - exact) / exact).abs().maxCoeff(), 0.005);
    EXPECT_LT(product.radiance(0, Vec2(0.75, 0.75), eye).abs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace lightwell
