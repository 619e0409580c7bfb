#include "radiance4d/operator/reflection.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "radiance4d/basis/angular_shares.h"
#include "radiance4d/basis/direction_map.h"
#include "radiance4d/operator/directed_light.h"
#include "radiance4d/scene/brdf.h"
#include "tests/unit/basis/samples.h"

namespace lightwell {
namespace {

/// A diffuse side, a glossy one with directions, and a glossy one without.
struct ThreeSides {
    ThreeSides() {
        scene.materials.resize(2);
        scene.materials[0].reflectance = Rgb(0.2, 0.4, 0.8);
        scene.materials[1].reflectance = Rgb(0.1, 0.2, 0.3);
        scene.materials[1].lobe = PhongLobe{Rgb(0.6, 0.5, 0.2), 5};
        std::vector<Element> elements;
        for (int q = 0; q < 3; ++q) {
            scene.quads.push_back({testing::trapezoid(), q == 0 ? 0 : 1, 0, 0});
            Element element;
            element.quad = q;
            element.geometry = testing::trapezoid();
            element.space = HaarBasis(element.geometry, CellTree({Split::u, Split::both}));
            if (q == 1) element.angle = angular_basis(2).tree();
            elements.push_back(element);
        }
        space = RadianceSpace(elements);
    }

    Scene scene;
    RadianceSpace space;
};

RadianceField numbers(std::uint32_t rows) {
    testing::Numbers numbers(3);
    return numbers.matrix(rows, 3).array();
}

TEST(Reflection, WithoutDirectionsIsTheMeanAlbedo) {
    const ThreeSides sides;
    const RadianceField in = numbers(sides.space.functions());
    const RadianceField out = Reflection(sides.scene, sides.space).outgoing(in);
    for (const std::size_t e : {std::size_t{0}, std::size_t{2}}) {
        const Element& element = sides.space.element(e);
        const Rgb rho = mean_albedo(sides.scene.material_of(element.quad));
        for (std::uint32_t f = element.first; f < element.first + element.functions(); ++f)
            for (int c = 0; c < 3; ++c)
                EXPECT_EQ(out(f, c), in(f, c) * rho[c]);
    }
}

// By hand, function by function: space is left alone, directions go through the lobe.
TEST(Reflection, ActsOnDirectionsAlone) {
    const ThreeSides sides;
    const RadianceField in = numbers(sides.space.functions());
    const RadianceField out = Reflection(sides.scene, sides.space).outgoing(in);
    const Element& element = sides.space.element(1);
    const RowMatrix lobe = AngularReflection::at_level(sides.scene.materials[1].lobe, 2).matrix();
    for (std::uint32_t f = 0; f < element.space.tree().functions(); ++f)
        for (std::uint32_t a = 0; a < 16; ++a)
            for (int c = 0; c < 3; ++c) {
                double sum = 0;
                for (std::uint32_t b = 0; b < 16; ++b)
                    sum += lobe(a, b) * in(element.first + 16 * f + b, c);
                sum *= lobe_reflectance(sides.scene.materials[1].lobe)[c];
                if (a == 0)
                    sum += sides.scene.materials[1].reflectance[c] * in(element.first + 16 * f, c);
                EXPECT_NEAR(out(element.first + 16 * f + a, c), sum, 1e-12);
            }
}

// Of one channel, several fields at once, some of whose functions are dark: the same but for what
// is left out of a sharp lobe, of which nine tenths of the coefficients are next to nothing.
TEST(Reflection, OfSeveralFieldsIsThatOfEach) {
    for (const double exponent : {5.0, 200.0}) {
        ThreeSides sides;
        sides.scene.materials[1].lobe = PhongLobe{Rgb(0.3, 0.4, 0.5), exponent};
        std::vector<Element> elements = sides.space.elements();
        elements[1].angle = angular_basis(4).tree();
        const RadianceSpace space(std::move(elements));
        const Reflection reflection(sides.scene, space);
        RadianceField in = numbers(space.functions());
        for (Eigen::Index j = 0; j < in.rows(); j += 3)
            in.row(j).setZero();
        const RadianceField each = reflection.outgoing(in);
        for (int c = 0; c < 3; ++c) {
            Rgb shares = Rgb::Zero();
            shares[c] = 1;
            Reflection::Fields out(in.rows(), 3);
            reflection.reflect(shares, in, out);
            EXPECT_LT((out.col(c) - each.col(c)).matrix().norm(),
                      2e-5 * each.col(c).matrix().norm());
        }
    }
}

// A point source's light has the irradiance it was given, and comes from where the source is.
TEST(DirectedLight, KeepsIrradianceAndDirection) {
    const ThreeSides sides;
    const Element& element = sides.space.element(1);
    const std::uint32_t cells = element.space.tree().functions();
    testing::Numbers numbers(5);
    const RadianceField irradiance = numbers.matrix(cells, 3, 1, 2).array();
    const Vec3 source = element.geometry.centre() + 0.8 * element.geometry.normal();
    RadianceField field = RadianceField::Zero(sides.space.functions(), 3);
    add_directed_light(element, source, irradiance, field);
    EXPECT_LT((cell_irradiance(sides.space, 1, field) - irradiance).abs().maxCoeff(), 1e-12);

    // Unfold into finest cells and angular cells.
    RowMatrix rows = Eigen::Map<const RowMatrix>(field.col(0).data() + element.first, cells, 16);
    element.space.synthesise(rows, element.space.tree().levels());
    RowMatrix columns = rows.transpose();
    angular_basis(2).synthesise(columns, 2);
    const Eigen::Matrix3d frame = local_frame(element.geometry);
    for (std::uint32_t m = 0; m < cells; ++m) {
        const Vec3 local = frame.transpose() *
                           (source - element.cell({element.space.tree().levels(), m}).centre());
        const auto around = angular_shares(element.angle, 2, local);
        const std::uint32_t expected =
            std::max_element(around.begin(), around.end(), [](const auto& one, const auto& other) {
                return one.share < other.share;
            })->cell;
        Eigen::Index strongest = 0;
        columns.col(m).maxCoeff(&strongest);
        EXPECT_GT(columns(expected, m), 0) << m;
        EXPECT_GE(columns.col(m).minCoeff(), -1e-12);
        // Most of the light is within one cell of the direction to the middle.
        const ParameterRect a = element.angle.rect({2, expected});
        const ParameterRect b = element.angle.rect({2, static_cast<std::uint32_t>(strongest)});
        EXPECT_LE(std::abs(a.u0 - b.u0), 0.25) << m;
        EXPECT_LE(std::abs(a.v0 - b.v0), 0.25) << m;
    }
    // Nothing elsewhere.
    EXPECT_EQ(field.topRows(element.first).abs().maxCoeff(), 0);
}

// As the paper takes it: the same irradiance, from everywhere alike.
TEST(DirectedLight, ForgetsDirectionsAndKeepsIrradiance) {
    const ThreeSides sides;
    const RadianceField field = numbers(sides.space.functions());
    const RadianceField spread = without_directions(sides.space, field);
    for (std::size_t e = 0; e < sides.space.elements().size(); ++e)
        EXPECT_LT((cell_irradiance(sides.space, e, spread) - cell_irradiance(sides.space, e, field))
                      .abs()
                      .maxCoeff(),
                  1e-12);
    const Element& glossy = sides.space.element(1);
    for (std::uint32_t f = 0; f < glossy.functions(); ++f)
        if (f % 16 != 0) {
            EXPECT_EQ(spread.row(glossy.first + f).abs().maxCoeff(), 0) << f;
        }
    EXPECT_TRUE((spread.topRows(glossy.first) == field.topRows(glossy.first)).all());
}

}  // namespace
}  // namespace lightwell
