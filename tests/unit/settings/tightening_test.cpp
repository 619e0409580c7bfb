#include "solver/tightening.h"

#include <cmath>
#include <optional>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

const Settings start{0.4, 1e-4, 0.06, 0.6};
constexpr double missed = 2;

void finer_cells(double by, Settings& settings) {
    settings.cell_size /= by;
}

void tighter_links(double by, Settings& settings) {
    settings.oracle_tolerance /= by;
}

/// As many bytes as there are more cells and links than at the start.
double memory(const Settings& settings) {
    return 100 * std::pow(start.cell_size / settings.cell_size, 2) * start.oracle_tolerance /
           settings.oracle_tolerance;
}

std::optional<Settings> tightened(double allowed) {
    return tighter_settings(start, missed, {finer_cells, tighter_links}, memory, allowed);
}

TEST(TighterSettings, TakeTheFirstWayWhereItFits) {
    const std::optional<Settings> settings = tightened(400);
    ASSERT_TRUE(settings);
    EXPECT_DOUBLE_EQ(settings->cell_size, start.cell_size / missed);
    EXPECT_EQ(settings->oracle_tolerance, start.oracle_tolerance);
}

TEST(TighterSettings, TakeTheSecondWhereTheFirstDoesNotFit) {
    const std::optional<Settings> settings = tightened(399);
    ASSERT_TRUE(settings);
    EXPECT_EQ(settings->cell_size, start.cell_size);
    EXPECT_DOUBLE_EQ(settings->oracle_tolerance, start.oracle_tolerance / missed);
}

TEST(TighterSettings, TakeTheSecondWhereTheFirstChangesNothing) {
    const auto nothing = [](double, Settings&) {};
    const std::optional<Settings> settings =
        tighter_settings(start, missed, {nothing, tighter_links}, memory, 1e9);
    ASSERT_TRUE(settings);
    EXPECT_LT(settings->oracle_tolerance, start.oracle_tolerance);
}

TEST(TighterSettings, TakeASmallerStepWhereNeitherFits) {
    const std::optional<Settings> settings = tightened(150);
    ASSERT_TRUE(settings);
    EXPECT_EQ(settings->cell_size, start.cell_size);
    EXPECT_LT(settings->oracle_tolerance, start.oracle_tolerance);
    EXPECT_GT(settings->oracle_tolerance, start.oracle_tolerance / missed);
    EXPECT_LE(memory(*settings), 150);
}

TEST(TighterSettings, EndWhereNoStepFits) {
    EXPECT_FALSE(tightened(100));
}

TEST(MemoryForLinks, GrowsWithThem) {
    Settings tighter = start;
    EXPECT_GT(memory_for_links(1000, start, tighter), 16 * 1000);
    tighter.oracle_tolerance /= 10;
    const double for_tighter = memory_for_links(1000, start, tighter);
    EXPECT_GT(for_tighter, memory_for_links(1000, start, start));
    tighter.cell_size /= 2;
    EXPECT_DOUBLE_EQ(memory_for_links(1000, start, tighter), 4 * for_tighter);
}

}  // namespace
}  // namespace lightwell
