#include "viewer/charts/chart_axis.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

TEST(ChartAxis, GoesByLogarithmsFromOnePixelToAnother) {
    const ChartAxis axis(1, 100, 200, 0);
    EXPECT_NEAR(axis.at(10), 100, 1e-9);
    EXPECT_NEAR(axis.at(1) - axis.at(10), axis.at(10) - axis.at(100), 1e-9);
    EXPECT_NEAR(axis.at(axis.lowest()), 200, 1e-9);
    EXPECT_NEAR(axis.at(axis.highest()), 0, 1e-9);
    EXPECT_LT(axis.lowest(), 1);
    EXPECT_GT(axis.highest(), 100);
}

TEST(ChartAxis, CountsEvenlyWhereItIsLinear) {
    const ChartAxis axis(1, 5, 0, 100, ChartAxis::Scale::linear);
    EXPECT_NEAR(axis.at(3), 50, 1e-9);
    EXPECT_EQ(axis.ticks(), (std::vector<double>{1, 2, 3, 4, 5}));
    EXPECT_LE(ChartAxis(1, 1000, 0, 1, ChartAxis::Scale::linear).ticks().size(), 13U);
}

TEST(ChartAxis, HasRoundTicksAndAtLeastFourWhereThatCanBeHad) {
    EXPECT_EQ(ChartAxis(1, 1000, 0, 1).ticks(), (std::vector<double>{1, 10, 100, 1000}));
    for (const double width : {1.6, 2.0, 5.0, 30.0, 1e3, 1e9})
        for (const double start : {1e-4, 0.7, 1.0, 3.3, 98.0}) {
            const ChartAxis axis(start, width * start, 0, 1);
            const std::vector<double> ticks = axis.ticks();
            EXPECT_GE(ticks.size(), 4U) << start << " and " << width;
            for (const double tick : ticks) {
                EXPECT_GE(tick, axis.lowest());
                EXPECT_LE(tick, axis.highest());
            }
        }
}

TEST(ChartAxis, OfOneValueHasSomeLength) {
    const ChartAxis axis(5, 5, 0, 1);
    EXPECT_NEAR(axis.at(5), 0.5, 1e-9);
    EXPECT_TRUE(std::isfinite(axis.at(6)));
}

TEST(TickText, IsShort) {
    EXPECT_EQ(tick_text(0.05), "0.05");
    EXPECT_EQ(tick_text(20), "20");
    EXPECT_EQ(tick_text(5000), "5000");
    EXPECT_EQ(tick_text(20e3), "20 k");
    EXPECT_EQ(tick_text(1.5e6), "1.5 M");
}

}  // namespace
}  // namespace lightwell
