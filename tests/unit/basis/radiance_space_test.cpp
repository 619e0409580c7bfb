#include "radiance4d/basis/radiance_space.h"

#include <cmath>

#include <gtest/gtest.h>

#include "radiance4d/operator/radiance_field.h"
#include "tests/unit/basis/samples.h"

namespace lightwell {
namespace {

Element element_on(int quad, bool front, const CellTree& tree, std::vector<OpenMask> open = {}) {
    Element element;
    element.quad = quad;
    element.front = front;
    element.geometry = front ? testing::trapezoid() : testing::trapezoid().reversed();
    element.set_space(tree, std::move(open));
    return element;
}

const CellTree tree_a({Split::u, Split::both});

/// A side that is open, a side with a half-buried cell and a buried one, and a quad left out.
RadianceSpace sample_space() {
    std::vector<OpenMask> open(tree_a.functions(), all_open);
    open[2] = 0x00000000FFFFFFFF;
    open[5] = 0;
    return RadianceSpace({element_on(0, true, tree_a), element_on(0, false, CellTree()),
                          element_on(2, true, tree_a, open)});
}

TEST(RadianceSpace, NumbersFunctionsElementByElement) {
    const RadianceSpace space = sample_space();
    EXPECT_EQ(space.functions(), 17U);
    EXPECT_EQ(space.element(0).first, 0U);
    EXPECT_EQ(space.element(1).first, 8U);
    EXPECT_EQ(space.element(2).first, 9U);
    for (std::uint32_t f = 0; f < space.functions(); ++f)
        EXPECT_EQ(space.element_of(f), f < 8 ? 0U : f < 9 ? 1U : 2U) << f;
}

TEST(RadianceSpace, FindsTheElementOnASide) {
    const RadianceSpace space = sample_space();
    EXPECT_EQ(space.element_on(0, true), 0);
    EXPECT_EQ(space.element_on(0, false), 1);
    EXPECT_EQ(space.element_on(2, true), 2);
    EXPECT_EQ(space.element_on(1, true), -1);
    EXPECT_EQ(space.element_on(1, false), -1);
    EXPECT_EQ(space.element_on(2, false), -1);
    EXPECT_EQ(space.element_on(7, true), -1);
}

TEST(Element, MaskSamplesAreOpenOneByOne) {
    // One open sample in cell 0, at (6.5/8, 2.5/8) of the cell.
    std::vector<OpenMask> open(tree_a.functions(), 0);
    open[0] = OpenMask{1} << (8 * 2 + 6);
    const Element element = element_on(0, true, tree_a, open);
    const ParameterRect r = tree_a.rect({tree_a.levels(), 0});
    for (int j = 0; j < 8; ++j) {
        for (int i = 0; i < 8; ++i) {
            const double u = r.u0 + (i + 0.5) / 8 * (r.u1 - r.u0);
            const double v = r.v0 + (j + 0.5) / 8 * (r.v1 - r.v0);
            EXPECT_EQ(element.is_sample_open(u, v), i == 6 && j == 2) << i << "," << j;
        }
    }
}

TEST(Element, WithoutMasksAllIsOpen) {
    const Element element = element_on(0, true, tree_a);
    EXPECT_TRUE(element.is_sample_open(0.3, 0.7));
    EXPECT_NEAR(element.area(), testing::trapezoid().area(), 1e-14);
}

TEST(Element, MeasuresOnlyWhatIsOpen) {
    const RadianceSpace space = sample_space();
    const Element& open = space.element(0);
    const Element& partly = space.element(2);
    const auto area = [](const Element& e, std::uint32_t m) {
        return e.space.area({tree_a.levels(), m});
    };
    EXPECT_NEAR(area(partly, 2), 0.5 * area(open, 2), 1e-14);
    // A buried cell counts for next to nothing, but not for nothing.
    EXPECT_GT(area(partly, 5), 0);
    EXPECT_LT(area(partly, 5), area(open, 5) / 64);
    EXPECT_NEAR(area(partly, 3), area(open, 3), 1e-14);
}

TEST(RadianceField, IrradianceOfCellsComesBack) {
    const RadianceSpace space = sample_space();
    testing::Numbers numbers(16);
    RadianceField field = numbers.matrix(space.functions(), 3).array();
    const RadianceField before = field;
    const RadianceField irradiance = numbers.matrix(8, 3, 0, 100).array();
    set_cell_irradiance(space, 2, irradiance, field);
    EXPECT_LT((cell_irradiance(space, 2, field) - irradiance).abs().maxCoeff(), 1e-11);
    EXPECT_TRUE((field.topRows(9) == before.topRows(9)).all()) << "other elements are untouched";
}

TEST(RadianceField, ConstantIrradianceIsTheCoarsestCoefficient) {
    const RadianceSpace space = sample_space();
    RadianceField field = RadianceField::Zero(space.functions(), 3);
    set_cell_irradiance(space, 2, RadianceField::Constant(8, 3, 5), field);
    const Element& element = space.element(2);
    EXPECT_NEAR(field(element.first, 0), 5 / M_PI * std::sqrt(element.area()), 1e-12);
    EXPECT_LT(field.bottomRows(7).abs().maxCoeff(), 1e-12);
}

TEST(RadianceField, NormIsThatOfMeanRadianceOverArea) {
    const RadianceSpace space = sample_space();
    RadianceField field = RadianceField::Zero(space.functions(), 3);
    const RadianceField irradiance = testing::Numbers(17).matrix(8, 3, 0, 10).array();
    set_cell_irradiance(space, 0, irradiance, field);
    for (int c = 0; c < 3; ++c) {
        double square = 0;
        for (std::uint32_t m = 0; m < 8; ++m)
            square += std::pow(irradiance(m, c) / M_PI, 2) *
                      space.element(0).cell({tree_a.levels(), m}).area();
        EXPECT_NEAR(field.col(c).matrix().squaredNorm(), square, 1e-12 * square);
    }
}

TEST(RadianceField, FluxIsIrradianceTimesArea) {
    const RadianceSpace space = sample_space();
    testing::Numbers numbers(18);
    RadianceField field = RadianceField::Zero(space.functions(), 3);
    Rgb flux = Rgb::Zero();
    for (std::size_t e = 0; e < 3; ++e) {
        const Element& element = space.element(e);
        const CellTree& tree = element.space.tree();
        const RadianceField irradiance = numbers.matrix(tree.functions(), 3, 0, 10).array();
        set_cell_irradiance(space, e, irradiance, field);
        for (std::uint32_t m = 0; m < tree.functions(); ++m)
            flux += element.space.area({tree.levels(), m}) * irradiance.row(m).transpose();
    }
    EXPECT_LT((total_flux(space, field) - flux).abs().maxCoeff(), 1e-11);
}

}  // namespace
}  // namespace lightwell
