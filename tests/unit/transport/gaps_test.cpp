// Where elements face each other more closely than a cell is wide.
#include "solver/transport/gaps.h"

#include <cmath>

#include <gtest/gtest.h>

#include "solver/precompute.h"
#include "solver/transport/elements.h"
#include "tests/unit/radiance4d/rooms.h"

namespace lightwell {
namespace {

constexpr int most_levels = 9;

Element element(const Quad& quad) {
    Element result;
    result.geometry = quad;
    return result;
}

Quad rectangle(const Vec3& corner, const Vec3& along, const Vec3& across) {
    return {{corner, corner + along, corner + along + across, corner + across}};
}

/// A ceiling of 4 x 2 m at a height of 3 m that looks down, and a lamp's housing of 0.6 x 0.4 m
/// below that looks up, turned about the vertical.
std::vector<Element> ceiling_and_housing(double gap, double turned = 0) {
    const Vec3 along(std::cos(turned), std::sin(turned), 0), across(-along[1], along[0], 0);
    return {element(rectangle({0, 0, 3}, {0, 2, 0}, {4, 0, 0})),
            element(rectangle(Vec3(2, 1, 3 - gap) - 0.3 * along - 0.2 * across, 0.6 * along,
                              0.4 * across))};
}

TEST(Gaps, HaveAHeightAndARim) {
    const std::vector<Gap> gaps = gaps_between(ceiling_and_housing(0.03), 0.1);
    ASSERT_EQ(gaps.size(), 1U);
    EXPECT_EQ(gaps[0].first, 0U);
    EXPECT_EQ(gaps[0].second, 1U);
    EXPECT_NEAR(gaps[0].height, 0.03, 1e-12);
    EXPECT_NEAR(gaps[0].rim, 2 * (0.6 + 0.4), 1e-12);
}

TEST(Gaps, AreNotWhereNothingFacesAnother) {
    std::vector<Element> elements = ceiling_and_housing(0.03);
    EXPECT_TRUE(gaps_between(elements, 0.02).empty()) << "higher than asked for";
    EXPECT_TRUE(gaps_between(ceiling_and_housing(0), 0.1).empty()) << "in contact";
    elements[1].geometry = elements[1].geometry.reversed();
    EXPECT_TRUE(gaps_between(elements, 0.1).empty()) << "both look down";
    elements = ceiling_and_housing(0.03);
    for (Vec3& corner : elements[1].geometry.vertex)
        corner[0] += 5;
    EXPECT_TRUE(gaps_between(elements, 0.1).empty()) << "side by side";
    elements = ceiling_and_housing(0.03);
    for (Vec3& corner : elements[1].geometry.vertex)
        corner[2] -= (corner[0] - 1.7) * 0.1;
    EXPECT_TRUE(gaps_between(elements, 0.2).empty()) << "tilted";
}

// Whatever the unit of length and however the housing is turned, the rim is about its own.
TEST(Gaps, ScaleAndTurn) {
    for (const double scale : {1e-3, 1.0, 1e3}) {
        std::vector<Element> elements = ceiling_and_housing(0.03, 0.4);
        for (Element& one : elements)
            for (Vec3& corner : one.geometry.vertex)
                corner *= scale;
        const std::vector<Gap> gaps = gaps_between(elements, 0.1 * scale);
        ASSERT_EQ(gaps.size(), 1U);
        EXPECT_NEAR(gaps[0].height, 0.03 * scale, 1e-9 * scale);
        EXPECT_GE(gaps[0].rim, 2.0 * scale);
        EXPECT_LE(gaps[0].rim, 2.0 * std::sqrt(2.0) * scale);
    }
}

// The squared error grows as the width of the cells and the length of the rims, and shrinks as the
// area that they are in.
TEST(Gaps, AskForCellsByErrorAndRim) {
    const std::vector<Gap> one = {{0, 1, 0.01, 2}}, two = {{0, 1, 0.01, 2}, {0, 2, 0.01, 2}};
    const double width = gap_cell_size(one, 0.1, 24, 0.02);
    EXPECT_GT(width, 0);
    EXPECT_NEAR(gap_cell_size(one, 0.1, 24, 0.04), 4 * width, 1e-12);
    EXPECT_NEAR(gap_cell_size(one, 0.1, 48, 0.02), 2 * width, 1e-12);
    EXPECT_NEAR(gap_cell_size(two, 0.1, 24, 0.02), width / 2, 1e-12);
    EXPECT_TRUE(std::isinf(gap_cell_size(one, 0.005, 24, 0.02))) << "cells show the gap as it is";
    EXPECT_TRUE(std::isinf(gap_cell_size({}, 0.1, 24, 0.02)));
}

TEST(Gaps, AreGivenFinerCells) {
    constexpr double cell_size = 0.25;
    const std::vector<Element> plain = [] {
        std::vector<Element> elements = ceiling_and_housing(0.03);
        elements.push_back(element(rectangle({0, 0, 0}, {4, 0, 0}, {0, 2, 0})));
        set_cells(elements, cell_size, most_levels);
        return elements;
    }();
    const std::vector<Gap> gaps = gaps_between(plain, cell_size);
    const auto refined_to = [&](double gap_cells) {
        std::vector<Element> elements = plain;
        set_gap_cells(gaps, cell_size, gap_cells, most_levels, elements);
        EXPECT_EQ(elements[2].functions(), plain[2].functions()) << "the floor has no part in it";
        return elements;
    };
    EXPECT_EQ(refined_to(0)[0].functions(), 128U * 64) << "4 x 2 m in cells of at most 6 cm";
    EXPECT_EQ(refined_to(0)[1].functions(), 16U * 8);
    EXPECT_EQ(refined_to(0.1)[0].functions(), 64U * 32);
    EXPECT_EQ(refined_to(0.3)[0].functions(), plain[0].functions());
    EXPECT_EQ(refined_to(0.3)[1].functions(), plain[1].functions());
}

/// How many times as many cells a ceiling has because a panel hangs 2 cm below it, of an operator
/// that is not judged.
double cells_for_gap(const PrecomputeOptions& options) {
    const auto ceiling_cells = [&options](bool with_panel) {
        Scene scene;
        Material grey;
        grey.reflectance = Rgb::Constant(0.5);
        scene.materials.push_back(grey);
        for (const Quad& wall : box_walls({0, 0, 0}, {2, 2, 2}))
            scene.quads.push_back({wall, 0});
        if (with_panel) scene.quads.push_back({level_rectangle(0.7, 1.3, 0.7, 1.3, 1.98), 0});
        PrecomputeReport report;
        const GlobalTransport transport = precompute(scene, options, {}, report);
        constexpr int ceiling = 5;
        return transport.space
            .element(static_cast<std::size_t>(transport.space.element_on(ceiling, true)))
            .functions();
    };
    return static_cast<double>(ceiling_cells(true)) / ceiling_cells(false);
}

// No more than needed: at a large error the gap does not show, and a size set by hand is meant.
TEST(Gaps, CostNothingWhereTheErrorAllowsThem) {
    PrecomputeOptions options;
    options.most_attempts = 0;
    options.error = 0.2;
    EXPECT_EQ(cells_for_gap(options), 1);
    options.error = 0.03;
    EXPECT_GE(cells_for_gap(options), 4);
    options.cell_size = 0.2;
    EXPECT_EQ(cells_for_gap(options), 1);
}

}  // namespace
}  // namespace lightwell
