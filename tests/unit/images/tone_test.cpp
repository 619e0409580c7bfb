#include "viewer/images/tone.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

TEST(Tone, SrgbMatchesTheStandard) {
    EXPECT_DOUBLE_EQ(srgb_encoded(0), 0);
    EXPECT_DOUBLE_EQ(srgb_encoded(1), 1);
    EXPECT_NEAR(srgb_encoded(0.002), 0.02584, 1e-9);
    // The standard's decoding of 0.5 is ((0.5 + 0.055) / 1.055)^2.4.
    EXPECT_NEAR(srgb_encoded(std::pow(0.555 / 1.055, 2.4)), 0.5, 1e-12);
    for (const double linear : {0.0, 0.002, 0.0031308, 0.2, 1.0})
        EXPECT_NEAR(srgb_decoded(srgb_encoded(linear)), linear, 1e-12);
    // Both branches meet.
    EXPECT_NEAR(srgb_encoded(0.0031308), srgb_encoded(0.0031309), 2e-6);
    EXPECT_DOUBLE_EQ(srgb_encoded(-3), 0);
    EXPECT_DOUBLE_EQ(srgb_encoded(7), 1);
}

TEST(Tone, FilmicRisesFromNothingToOne) {
    EXPECT_DOUBLE_EQ(filmic(0), 0);
    EXPECT_DOUBLE_EQ(filmic(-1), 0);
    EXPECT_NEAR(filmic(1), 2.54 / 3.16, 1e-12);
    double before = 0;
    for (double x = 0.01; x < 7; x *= 1.1) {
        EXPECT_GT(filmic(x), before) << x;
        EXPECT_LE(filmic(x), 1) << x;
        before = filmic(x);
    }
    EXPECT_DOUBLE_EQ(filmic(std::numeric_limits<double>::infinity()), 1);
}

TEST(Tone, ExposureCountsInDoublings) {
    Image light(2, 1);
    light.at(0, 0) = Image::Pixel(0.1f, 0.2f, 3.0f);
    light.at(1, 0).setConstant(std::numeric_limits<float>::quiet_NaN());
    const Image display = develop(light, {2.0, ToneCurve::clip});
    EXPECT_FLOAT_EQ(display.at(0, 0)[0], 0.4f);
    EXPECT_FLOAT_EQ(display.at(0, 0)[1], 0.8f);
    EXPECT_FLOAT_EQ(display.at(0, 0)[2], 1.0f);
    EXPECT_TRUE(std::isnan(display.at(1, 0)[0]));
    EXPECT_FLOAT_EQ(develop(light, {-1.0, ToneCurve::filmic}).at(0, 0)[2],
                    static_cast<float>(filmic(1.5)));
}

TEST(Tone, AutomaticExposureBringsTheLogAverageToMiddleGrey) {
    Image light(4, 1);
    light.at(0, 0).setConstant(10);
    light.at(1, 0).setConstant(1000);
    light.at(2, 0).setConstant(std::numeric_limits<float>::infinity());
    // Black, as pixel 3, and non-finite pixels do not count: the log-average is 100.
    EXPECT_NEAR(100 * std::exp2(automatic_exposure(light)), 0.18, 1e-6);
    EXPECT_DOUBLE_EQ(automatic_exposure(Image(2, 2)), 0);
}

}  // namespace
}  // namespace lightwell
