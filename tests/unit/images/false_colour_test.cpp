#include "viewer/images/false_colour.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "viewer/images/lettering.h"

namespace lightwell {
namespace {

bool same(const Image::Pixel& a, const Image::Pixel& b) {
    return (a == b).all();
}

/// Luminance rises from 0 at the left to `top` at the right.
Image slope(int width, int height, double top) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y).setConstant(static_cast<float>(top * (x + 0.5) / width));
    return image;
}

TEST(FalseColour, TheRampCanBeReadInGrey) {
    float before = -1;
    for (int k = 0; k <= 256; ++k) {
        const Image::Pixel colour = ramp_colour(k / 256.0);
        EXPECT_GT(luminance(colour), before) << k;
        EXPECT_TRUE((colour >= 0.0f).all() && (colour <= 1.0f).all()) << k;
        // Oklab lightness is about the cube root of luminance: even steps, none larger than twice
        // the mean.
        if (before > 0) {
            EXPECT_LT(std::cbrt(luminance(colour)) - std::cbrt(before), 2 * 0.65 / 256) << k;
        }
        before = luminance(colour);
    }
    EXPECT_TRUE(same(ramp_colour(-1), ramp_colour(0)));
    EXPECT_TRUE(same(ramp_colour(2), ramp_colour(1)));
}

TEST(FalseColour, TheAutomaticMaximumIsRoundAndPassesOverTheBrightestTwentieth) {
    Image light = slope(1000, 1, 730);
    EXPECT_DOUBLE_EQ(automatic_maximum(light), 800);
    for (int x = 0; x < 49; ++x)
        light.at(x, 0).setConstant(1e6f);
    EXPECT_DOUBLE_EQ(automatic_maximum(light), 800);
    light.at(500, 0).setConstant(std::numeric_limits<float>::quiet_NaN());
    EXPECT_DOUBLE_EQ(automatic_maximum(light), 800);
    for (int x = 49; x < 60; ++x)
        light.at(x, 0).setConstant(1e6f);
    EXPECT_DOUBLE_EQ(automatic_maximum(light), 1e6);
    EXPECT_DOUBLE_EQ(automatic_maximum(slope(1, 1, 0.0026)), 0.0015);
    EXPECT_DOUBLE_EQ(automatic_maximum(Image(5, 5)), 1);
}

TEST(FalseColour, ValuesMapLinearlyToTheRamp) {
    const Image light = slope(100, 2, 500);
    FalseColour style;
    style.maximum = 500;
    style.legend = false;
    const Image picture = false_coloured(light, style);
    for (int x = 0; x < 100; ++x)
        EXPECT_TRUE((picture.at(x, 1) - ramp_colour((x + 0.5) / 100)).abs().maxCoeff() < 1e-5f);
    style.maximum = 5;
    EXPECT_TRUE(same(false_coloured(light, style).at(50, 0), ramp_colour(1)));
}

TEST(FalseColour, ContoursStandBetweenTheParts) {
    const Image light = slope(80, 4, 800);
    FalseColour style;
    style.maximum = 800;
    style.legend = false;
    style.contours = true;
    const auto has_line = [&](const Image& picture, int x) {
        return same(picture.at(x, 1), Image::Pixel::Zero());
    };
    const Image eight = false_coloured(light, style);
    for (int x = 0; x + 1 < 80; ++x)
        EXPECT_EQ(has_line(eight, x), x % 10 == 9) << x;
    // 1000 / 8 is 125, so it is cut into ten: 800 lies at 8 of 10.
    style.maximum = 1000;
    const Image ten = false_coloured(light, style);
    for (int x = 0; x + 1 < 80; ++x)
        EXPECT_EQ(has_line(ten, x), x % 10 == 9) << x;
    style.divisions = 5;
    const Image five = false_coloured(light, style);
    for (int x = 0; x + 1 < 80; ++x)
        EXPECT_EQ(has_line(five, x), x % 20 == 19) << x;
}

TEST(FalseColour, TheLegendShowsTheWholeRampUpright) {
    FalseColour style;
    style.maximum = 800;
    const Image with = false_coloured(slope(640, 480, 800), style);
    style.legend = false;
    const Image without = false_coloured(slope(640, 480, 800), style);
    // Along the bar the ramp rises from bottom to top, over at least a third of the picture.
    float brightest = 0;
    int rows = 0;
    for (int y = 479; y >= 0; --y) {
        if (same(with.at(8, y), without.at(8, y)) ||
            same(with.at(8, y), Image::Pixel::Constant(0.01f)))
            continue;
        EXPECT_GE(luminance(with.at(8, y)), brightest) << y;
        brightest = luminance(with.at(8, y));
        ++rows;
    }
    EXPECT_GT(rows, 160);
    EXPECT_GT(brightest, 0.99f * luminance(ramp_colour(1)));
    // The rest of the picture is untouched, and a small picture has no legend.
    EXPECT_TRUE(same(with.at(320, 240), without.at(320, 240)));
    style.legend = true;
    const Image tiny = false_coloured(slope(40, 30, 800), style);
    EXPECT_LT((tiny.at(1, 1) - ramp_colour(1.5 / 40)).abs().maxCoeff(), 1e-5f);
}

TEST(Lettering, DotsLieWhereTheGlyphHasThem) {
    Image image(20, 10);
    draw_text(image, 1, 2, "1", Image::Pixel::Ones(), 1);
    // The foot of the 1 is a whole row of five, its top one dot in the middle.
    for (int x = 0; x < 20; ++x) {
        EXPECT_EQ(image.at(x, 8)[0], x >= 1 && x <= 5 ? 1 : 0) << x;
        EXPECT_EQ(image.at(x, 2)[0], x == 3 ? 1 : 0) << x;
    }
    // Text over the edge is cut, not wrapped.
    draw_text(image, -3, -3, "88888", Image::Pixel::Ones(), 3);
    draw_text(image, 100, 100, "8", Image::Pixel::Ones(), 3);
}

}  // namespace
}  // namespace lightwell
