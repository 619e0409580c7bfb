#include "viewer/charts/measured_setting.h"

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

TEST(MeasuredSettings, AreRowsUnderAHeader) {
    EXPECT_EQ(
        csv_of(std::vector<MeasuredSetting>{setting("a", 1.5, 0.25)}),
        "method,setting,error,error_low,error_high,precompute_seconds,rays,coefficients,bytes,"
        "frame_milliseconds\na,as it is,0.25,0.225,0.3,1.5,0,0,0,0\n");
}

}  // namespace
}  // namespace lightwell
