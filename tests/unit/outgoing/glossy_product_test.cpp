#include "runtime/outgoing/glossy_product.h"

#include <cmath>

#include <gtest/gtest.h>

#include "radiance4d/basis/angular_reflection.h"
#include "radiance4d/scene/brdf.h"
#include "runtime/outgoing/brdf_product.h"

namespace lightwell {
namespace {

/// One glossy square under light that differs from place to place and from direction to direction.
class GlossySquare : public ::testing::TestWithParam<Lobe> {
  protected:
    void SetUp() override {
        scene.materials.resize(1);
        scene.materials[0].reflectance = Rgb(0.1, 0.2, 0.3);
        scene.materials[0].lobe = GetParam();
        const Quad square{{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 2, 0), Vec3(0, 2, 0)}};
        scene.quads = {{square, 0, 0, 0}};
        Element element;
        element.geometry = square;
        element.space = HaarBasis(square, CellTree({Split::both}));
        element.angle = angular_basis(3).tree();
        space = RadianceSpace({element});
    }

    Scene scene;
    RadianceSpace space;
};

TEST_P(GlossySquare, ReflectsUniformLightByItsAlbedo) {
    RadianceField one = RadianceField::Zero(space.functions(), 3);
    one.row(0) = std::sqrt(4.0);
    const GlossyProduct product(scene, space, one);
    for (const double degrees : {0.0, 30.0, 60.0, 75.0}) {
        const double theta = degrees * M_PI / 180;
        const Vec3 direction(std::sin(theta), 0, std::cos(theta));
        const Rgb exact = albedo(scene.materials[0], direction[2]);
        const Rgb seen = product.radiance(0, Vec2(0.3, 0.8), direction);
        EXPECT_LT(((seen - exact) / exact).abs().maxCoeff(), 0.005) << degrees;
    }
    EXPECT_EQ(product.radiance(0, Vec2(0.3, 0.8), Vec3(0.6, 0, -0.8))[0], 0);
}

TEST_P(GlossySquare, AgreesWithThePlainProduct) {
    RadianceField light = RadianceField::Zero(space.functions(), 3);
    // Bright enough to be nowhere negative: the product cuts that off, the plain one does not.
    light.row(0).setConstant(16);
    for (Eigen::Index j = 1; j < light.rows(); ++j)
        light.row(j).setConstant(std::sin(7.0 * static_cast<double>(j)) /
                                 (1 + 0.02 * static_cast<double>(j)));
    const GlossyProduct product(scene, space, light);
    const BrdfProduct plain(scene, space, light);
    double off = 0, squares = 0;
    for (const Vec2& centre : {Vec2(0.25, 0.25), Vec2(0.75, 0.25), Vec2(0.75, 0.75)})
        for (int k = 0; k < 40; ++k) {
            const double theta = 1.3 * (k + 0.5) / 40, phi = 2.4 * k;
            const Vec3 direction(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                 std::cos(theta));
            const Rgb exact = plain.radiance(0, centre, direction);
            off += (product.radiance(0, centre, direction) - exact).square().sum();
            squares += exact.square().sum();
        }
    EXPECT_LT(std::sqrt(off / squares), 0.002);
}

INSTANTIATE_TEST_SUITE_P(Lobes, GlossySquare,
                         ::testing::Values(Lobe(PhongLobe{Rgb(0.7, 0.5, 0.2), 5}),
                                           Lobe(PhongLobe{Rgb(0.7, 0.5, 0.2), 30}),
                                           Lobe(GgxLobe{Rgb(0.7, 0.5, 0.2), 0.5})));

}  // namespace
}  // namespace lightwell
