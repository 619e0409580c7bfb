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

// Of one channel, several fields at once, between functions of which some are left out.
TEST(Reflection, OfSeveralFieldsIsThatOfEach) {
    for (const double exponent : {5.0, 200.0}) {
        ThreeSides sides;
        sides.scene.materials[1].lobe = PhongLobe{Rgb(0.3, 0.4, 0.5), exponent};
        std::vector<Element> elements = sides.space.elements();
        elements[1].angle = angular_basis(4).tree();
        const RadianceSpace space(std::move(elements));
        const Reflection reflection(sides.scene, space);
        RadianceField in = numbers(space.functions());
        Reflection::Functions from, to;
        for (std::uint32_t j = 0; j < space.functions(); ++j) {
            if (j % 3 == 0)
                in.row(j).setZero();
            else
                from.push_back(j);
            if (j % 5 < 3) to.push_back(j);
        }
        Reflection::Fields lit =
            Reflection::Fields::Zero(static_cast<Eigen::Index>(from.size()), 8);
        for (std::size_t k = 0; k < from.size(); ++k)
            lit.row(static_cast<Eigen::Index>(k)).head<3>() = in.row(from[k]).cast<float>();
        const RadianceField each = reflection.outgoing(in);
        for (int c = 0; c < 3; ++c) {
            Rgb shares = Rgb::Zero();
            shares[c] = 1;
            Reflection::Fields out;
            reflection.reflect(shares, from, lit, to, out);
            ASSERT_EQ(out.rows(), static_cast<Eigen::Index>(to.size()));
            double off = 0, all = 0;
            for (std::size_t k = 0; k < to.size(); ++k) {
                const double wanted = each(to[k], c);
                off +=
                    std::pow(static_cast<double>(out(static_cast<Eigen::Index>(k), c)) - wanted, 2);
                all += wanted * wanted;
            }
            EXPECT_LT(off, 1e-12 * all);
            EXPECT_TRUE((out.col(7) == 0).all());
        }
    }
}

// As a matrix, R is what it does to fields, but for what is too small and rows that are not wanted.
TEST(Reflection, IsAMatrixOfTheRowsThatAreWanted) {
    const ThreeSides sides;
    const Reflection reflection(sides.scene, sides.space);
    const RadianceField in = numbers(sides.space.functions());
    std::vector<bool> wanted(sides.space.functions());
    for (std::size_t j = 0; j < wanted.size(); ++j)
        wanted[j] = j % 3 != 1;
    const Eigen::ArrayXd out =
        (reflection.matrix(Rgb(0, 1, 0), 0, wanted) * in.col(1).matrix()).array();
    const Eigen::ArrayXd expected = reflection.outgoing(in).col(1);
    for (std::size_t j = 0; j < wanted.size(); ++j) {
        const auto row = static_cast<Eigen::Index>(j);
        EXPECT_NEAR(out[row], wanted[j] ? expected[row] : 0, 1e-12);
    }
    const std::vector<bool> all(wanted.size(), true);
    EXPECT_LT(reflection.matrix(Rgb(0, 1, 0), 0.1, all).nonZeros(),
              reflection.matrix(Rgb(0, 1, 0), 0, all).nonZeros());
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
