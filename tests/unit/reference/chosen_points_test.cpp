#include "solver/reference/chosen_points.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// Points that are all seen alike, of which `dark` are shown no light and the others 1 lx.
CandidatePoints partly_dark(int count, int dark) {
    CandidatePoints candidates;
    for (int k = 0; k < count; ++k) {
        SurfacePoint point;
        point.quad = k;
        candidates.points.push_back(point);
        // Spread over all, but not evenly: samples are drawn at even steps.
        const bool is_dark = (k * 7919) % count < dark;
        candidates.shown.value.push_back(is_dark ? Rgb::Zero() : Rgb::Ones());
        candidates.shown.weight.push_back(1);
    }
    return candidates;
}

int dark_among(const ChosenPoints& chosen) {
    return static_cast<int>(std::count_if(chosen.shown.value.begin(), chosen.shown.value.end(),
                                          [](const Rgb& value) { return (value == 0).all(); }));
}

double weighted_share_of_dark(const ChosenPoints& chosen) {
    double dark = 0, all = 0;
    for (std::size_t k = 0; k < chosen.points.size(); ++k) {
        all += chosen.shown.weight[k];
        if ((chosen.shown.value[k] == 0).all()) dark += chosen.shown.weight[k];
    }
    return dark / all;
}

// The rim of a gap that is taken for dark: one in a hundred places would be met by luck.
TEST(ChosenPoints, LookWhereLittleIsShownDark) {
    const ChosenPoints chosen = chosen_points(partly_dark(2000, 20), 100, 0.5);
    ASSERT_EQ(chosen.points.size(), 100U);
    EXPECT_GE(dark_among(chosen), 6);
    EXPECT_LE(dark_among(chosen), 9);
}

// A building: the lamp lights one room of ten.
TEST(ChosenPoints, LookWhereThereIsLightIfMostIsDark) {
    const ChosenPoints chosen = chosen_points(partly_dark(2000, 1800), 100, 0.5);
    EXPECT_LE(dark_among(chosen), 50);
    EXPECT_GE(dark_among(chosen), 30);
}

TEST(ChosenPoints, CountByTheInverseOfTheirChance) {
    for (const int dark : {20, 400, 1800}) {
        double share = 0;
        constexpr int repetitions = 200;
        for (int r = 0; r < repetitions; ++r)
            share += weighted_share_of_dark(
                         chosen_points(partly_dark(2000, dark), 100, (r + 0.5) / repetitions)) /
                     repetitions;
        EXPECT_NEAR(share, dark / 2000.0, 0.05 * dark / 2000.0) << dark;
    }
}

}  // namespace
}  // namespace lightwell
