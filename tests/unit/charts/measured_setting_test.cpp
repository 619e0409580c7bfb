#include "viewer/charts/measured_setting.h"

#include <utility>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

MeasuredSetting setting(const std::string& method, double seconds, double error) {
    MeasuredSetting one;
    one.method = method;
    one.setting = "as it is";
    one.error = {error, 0.9 * error, 1.2 * error};
    one.precompute_seconds = seconds;
    return one;
}

double seconds(const MeasuredSetting& s) {
    return s.precompute_seconds;
}

TEST(MeasuredSettings, AreSeriesByMethodInPerCent) {
    const std::vector<Series> series = series_by_method(
        {setting("a", 1, 0.2), setting("b", 2, 0.1), setting("a", 3, 0.05), setting("c", 0, 0.1)},
        seconds);
    ASSERT_EQ(series.size(), 2U);
    EXPECT_EQ(series[0].name, "a");
    ASSERT_EQ(series[0].points.size(), 2U);
    EXPECT_DOUBLE_EQ(series[0].points[1].first, 3);
    EXPECT_DOUBLE_EQ(series[0].points[1].second, 5);
    EXPECT_DOUBLE_EQ(series[0].spans[1].second, 6);
}

TEST(MeasuredSettings, CheapestForTheirErrorAreThoseThatNoOtherBeats) {
    const std::vector<MeasuredSetting> front =
        cheapest({setting("late", 5, 0.1), setting("first", 1, 0.3), setting("worse", 2, 0.4),
                  setting("second", 3, 0.1), setting("free", 0, 0.01)},
                 seconds);
    ASSERT_EQ(front.size(), 2U);
    EXPECT_EQ(front[0].method, "first");
    EXPECT_EQ(front[1].method, "second");
}

TEST(MeasuredSettings, OfEqualCostTheMoreAccurateIsTheCheapest) {
    for (const bool better_first : {false, true}) {
        std::vector<MeasuredSetting> both = {setting("worse", 2, 0.3), setting("better", 2, 0.2)};
        if (better_first) std::swap(both[0], both[1]);
        const std::vector<MeasuredSetting> front = cheapest(both, seconds);
        ASSERT_EQ(front.size(), 1U);
        EXPECT_EQ(front[0].method, "better");
    }
}

TEST(MeasuredSettings, LookLikeTheirMethod) {
    MeasuredSetting varied = setting("by hand", 1, 0.1);
    varied.look = {3, 1};
    varied.is_one_of_a_line = false;
    const std::vector<Series> series = series_by_method({setting("a", 1, 0.2), varied}, seconds);
    ASSERT_EQ(series.size(), 2U);
    EXPECT_TRUE(series[0].is_joined);
    EXPECT_FALSE(series[0].shows_labels);
    EXPECT_FALSE(series[1].is_joined);
    EXPECT_TRUE(series[1].shows_labels);
    ASSERT_TRUE(series[1].look);
    EXPECT_EQ(series[1].look->colour, 3);
    EXPECT_EQ(series[1].labels, std::vector<std::string>{"as it is"});
}

TEST(MeasuredSettings, AreRowsUnderAHeaderWithNothingForWhatTheyDoNotCost) {
    MeasuredSetting one = setting("a", 1.5, 0.25);
    one.setting = "this, that";
    one.worst_lamp = 0.4;
    one.cells = 12;
    EXPECT_EQ(csv_of(std::vector<MeasuredSetting>{one}),
              "method,setting,error,error_low,error_high,error_of_worst_lamp,cells,"
              "precompute_seconds,rays,coefficients,bytes,frame_milliseconds\n"
              "a,\"this, that\",0.25,0.225,0.3,0.4,12,1.5,,,,\n");
}

}  // namespace
}  // namespace lightwell
