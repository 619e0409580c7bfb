#include "runtime/drawing/texture_atlas.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

TEST(TextureAtlas, TexturesAndTheirBordersDoNotOverlap) {
    const std::vector<TextureSize> sizes = {{1, 1}, {64, 2}, {3, 40}, {16, 16}, {16, 16}, {1, 7}};
    const TextureAtlas atlas(sizes);
    std::vector<int> owner(static_cast<std::size_t>(atlas.size().columns * atlas.size().rows), -1);
    for (std::size_t t = 0; t < sizes.size(); ++t) {
        const AtlasPlace& place = atlas.place(t);
        EXPECT_EQ(place.size.columns, sizes[t].columns);
        EXPECT_EQ(place.size.rows, sizes[t].rows);
        ASSERT_GE(place.left, 1);
        ASSERT_GE(place.top, 1);
        ASSERT_LT(place.left + sizes[t].columns, atlas.size().columns);
        ASSERT_LT(place.top + sizes[t].rows, atlas.size().rows);
        for (int y = place.top - 1; y <= place.top + sizes[t].rows; ++y)
            for (int x = place.left - 1; x <= place.left + sizes[t].columns; ++x) {
                int& here = owner[static_cast<std::size_t>(y * atlas.size().columns + x)];
                EXPECT_EQ(here, -1) << "texture " << t << " at " << x << ' ' << y;
                here = static_cast<int>(t);
            }
    }
}

TEST(TextureAtlas, AThousandTexturesLeaveLittleOfTheImageFree) {
    std::vector<TextureSize> sizes;
    double area = 0;
    for (int k = 0; k < 1000; ++k) {
        sizes.push_back({1 << k % 5, 1 << k / 7 % 5});
        area += (sizes.back().columns + 2.0) * (sizes.back().rows + 2.0);
    }
    const TextureAtlas atlas(sizes);
    EXPECT_LT(static_cast<double>(atlas.size().columns) * atlas.size().rows, 1.3 * area);
}

TEST(TextureAtlas, NoTexturesAreAnImageStill) {
    const TextureAtlas atlas({});
    EXPECT_GE(atlas.size().columns, 1);
    EXPECT_GE(atlas.size().rows, 1);
}

TEST(TextureAtlas, BilinearReproducesWhatIsLinear) {
    TextureAtlas atlas({{5, 3}, {4, 8}});
    const auto linear = [](double u, double v) { return static_cast<float>(2 + 3 * u - v); };
    for (int row = -1; row <= 8; ++row)
        for (int column = -1; column <= 4; ++column)
            atlas.texel(1, column, row) =
                linear((column + 0.5) / 4, (row + 0.5) / 8) * Packed(1, 2, 3, 0);
    for (double u = 0; u <= 1; u += 0.0625)
        for (double v = 0; v <= 1; v += 0.0625) {
            const Packed found = atlas.bilinear(1, u, v);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(found[c], static_cast<float>(c + 1) * linear(u, v), 1e-5F);
        }
}

TEST(TextureAtlas, InsideTheBorderIsNotRead) {
    TextureAtlas atlas({{1, 1}, {2, 2}});
    for (std::size_t t = 0; t < 2; ++t)
        for (int row = -1; row <= 2 && row <= atlas.place(t).size.rows; ++row)
            for (int column = -1; column <= atlas.place(t).size.columns; ++column) {
                const bool is_border = row < 0 || column < 0 || row == atlas.place(t).size.rows ||
                                       column == atlas.place(t).size.columns;
                atlas.texel(t, column, row) = Packed::Constant(is_border ? 1e6F : 1.0F);
            }
    for (std::size_t t = 0; t < 2; ++t)
        for (const double u : {0.0, 0.3, 1.0})
            for (const double v : {0.0, 0.6, 1.0}) {
                EXPECT_EQ(atlas.bilinear_inside(t, u, v)[0], 1.0F);
                EXPECT_EQ(atlas.nearest(t, u, v)[0], 1.0F);
            }
}

}  // namespace
}  // namespace lightwell
