#include "runtime/outgoing/lobe_synthesis.h"

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "radiance4d/basis/angular_reflection.h"
#include "runtime/outgoing/glossy_product.h"

namespace lightwell {
namespace {

/// A glossy floor, a part of it buried, under a diffuse ceiling.
class LobeTextures : public ::testing::Test {
  protected:
    void SetUp() override {
        Material glossy, diffuse;
        glossy.lobe = GgxLobe{Rgb(0.6, 0.5, 0.4), 0.4};
        transport.scene.materials = {glossy, diffuse};
        const Quad floor{{Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(3, 2, 0), Vec3(0, 2, 0)}};
        const Quad ceiling{{Vec3(0, 0, 2), Vec3(0, 2, 2), Vec3(3, 2, 2), Vec3(3, 0, 2)}};
        transport.scene.quads = {{floor, 0, 0, 0}, {ceiling, 1, 0, 0}};
        Element below, above;
        below.geometry = floor;
        below.space = HaarBasis(floor, CellTree({Split::both, Split::both}));
        below.angle = angular_basis(2).tree();
        below.open.assign(16, 1);
        below.open[3] = 0;
        above.quad = 1;
        above.geometry = ceiling;
        above.space = HaarBasis(ceiling, CellTree({Split::both}));
        transport.space = RadianceSpace({above, below});
        light = RadianceField::Zero(transport.space.functions(), 3);
        for (Eigen::Index j = 0; j < light.rows(); ++j)
            for (Eigen::Index c = 0; c < 3; ++c)
                light(j, c) =
                    std::sin(static_cast<double>(7 * j + c)) / (1 + 0.02 * static_cast<double>(j));
        light.row(transport.space.element(1).first).setConstant(20);
    }

    /// Every texel against the product at the centre of its cell.
    void expect_products(const LobeSynthesis& lobes, const Vec3& eye) const {
        const GlossyProduct product(transport.scene, transport.space, light);
        const TextureSize size = lobes.atlas().place(1).size;
        ASSERT_EQ(size.columns, 4);
        ASSERT_EQ(size.rows, 4);
        const Element& element = transport.space.element(1);
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column < 4; ++column) {
                const std::uint32_t cell = element.space.tree().finest_at(
                    static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
                if (element.open[cell] == 0) continue;
                const Vec2 uv((column + 0.5) / 4, (row + 0.5) / 4);
                const Vec3 point = element.geometry.point(uv[0], uv[1]);
                const Rgb exact = product.from_lobe(1, uv, (eye - point).normalized());
                const Rgb shown = lobes.atlas().texel(1, column, row).head<3>().cast<double>();
                EXPECT_LT((shown - exact).abs().maxCoeff(), 1e-4 * exact.maxCoeff())
                    << column << " " << row;
            }
    }

    GlobalTransport transport;
    RadianceField light;
};

TEST_F(LobeTextures, HoldTheProductOfLightAndLobe) {
    LobeSynthesis lobes(transport);
    ASSERT_TRUE(lobes.is_needed());
    lobes.take(packed(light));
    for (const Vec3& eye : {Vec3(0.5, -1, 1.5), Vec3(2.9, 1.2, 0.4)}) {
        EXPECT_EQ(lobes.synthesise(eye), 1u);
        expect_products(lobes, eye);
    }
    light *= 0.5;
    lobes.take(packed(light));
    EXPECT_EQ(lobes.synthesise(Vec3(2.9, 1.2, 0.4)), 1u);
    expect_products(lobes, Vec3(2.9, 1.2, 0.4));
}

TEST_F(LobeTextures, CostNothingAtRestNorBehind) {
    LobeSynthesis lobes(transport);
    lobes.take(packed(light));
    EXPECT_EQ(lobes.synthesise(Vec3(1, 1, -1)), 0u);
    // What was not seen is made when it is.
    EXPECT_EQ(lobes.synthesise(Vec3(1, 1, 1)), 1u);
    EXPECT_EQ(lobes.synthesise(Vec3(1, 1, 1)), 0u);
    lobes.take(packed(light));
    EXPECT_EQ(lobes.synthesise(Vec3(1, 1, 1)), 0u);
    light *= 2;
    lobes.take(packed(light));
    EXPECT_EQ(lobes.synthesise(Vec3(1, 1, -1)), 0u);
    EXPECT_EQ(lobes.synthesise(Vec3(1, 1, 1)), 1u);
    expect_products(lobes, Vec3(1, 1, 1));
}

TEST_F(LobeTextures, GiveWhatIsBuriedTheLightBesideIt) {
    LobeSynthesis lobes(transport);
    lobes.take(packed(light));
    lobes.synthesise(Vec3(1, 1, 1));
    const TextureAtlas& atlas = lobes.atlas();
    const ParameterRect r = transport.space.element(1).space.tree().rect({2, 3});
    const int column = static_cast<int>(4 * r.u0), row = static_cast<int>(4 * r.v0);
    EXPECT_GT(atlas.texel(1, column, row)[0], 0);
    // The border goes on as the rim does.
    const Packed last = atlas.texel(1, 0, 2), before = atlas.texel(1, 1, 2);
    const Packed further = (2.0F * last - before).max(0.0F).min(2.0F * last);
    EXPECT_LT((atlas.texel(1, -1, 2) - further).abs().maxCoeff(), 1e-5F * last.maxCoeff());
}

TEST_F(LobeTextures, AreDarkDeepInAGap) {
    Element below = transport.space.element(1);
    const CellTree& tree = below.space.tree();
    for (std::uint32_t row = 0; row < 4; ++row)
        for (std::uint32_t column = 0; column < 4; ++column)
            below.open[tree.finest_at(column, row)] = column == 0 ? 1 : 0;
    transport.space = RadianceSpace({transport.space.element(0), below});
    LobeSynthesis lobes(transport);
    lobes.take(packed(light));
    lobes.synthesise(Vec3(1, 1, 1));
    for (int row = 0; row < 4; ++row) {
        EXPECT_GT(lobes.atlas().texel(1, 2, row)[0], 0);
        EXPECT_EQ(lobes.atlas().texel(1, 3, row)[0], 0);
    }
}

/// Two floors side by side.
class LobesSideBySide : public ::testing::Test {
  protected:
    /// @return what is seen of the first and of the second where they meet, side by side
    std::vector<std::pair<Packed, Packed>> seen_at_the_seam(int second_material) {
        GlobalTransport transport;
        Material glossy, other;
        glossy.lobe = GgxLobe{Rgb(0.6, 0.5, 0.4), 0.4};
        other.lobe = GgxLobe{Rgb(0.1, 0.1, 0.1), 0.4};
        transport.scene.materials = {glossy, other};
        std::vector<Element> elements(2);
        for (int k = 0; k < 2; ++k) {
            const Quad floor{{Vec3(k, 0, 0), Vec3(k + 1, 0, 0), Vec3(k + 1, 1, 0), Vec3(k, 1, 0)}};
            Element& element = elements[static_cast<std::size_t>(k)];
            transport.scene.quads.push_back({floor, k * second_material, 0, 0});
            element.quad = k;
            element.geometry = floor;
            element.space = HaarBasis(floor, CellTree({Split::both, Split::both}));
            element.angle = angular_basis(2).tree();
        }
        transport.space = RadianceSpace(elements);
        RadianceField light = RadianceField::Zero(transport.space.functions(), 3);
        for (const Element& element : transport.space.elements())
            light.row(element.first).setConstant(element.quad == 0 ? 20 : 30);
        LobeSynthesis lobes(transport);
        lobes.take(packed(light));
        lobes.synthesise(Vec3(0.7, -1, 1));
        std::vector<std::pair<Packed, Packed>> seen;
        for (double v = 0.05; v < 1; v += 0.1)
            seen.emplace_back(lobes.atlas().bilinear(0, 1, v), lobes.atlas().bilinear(1, 0, v));
        return seen;
    }
};

TEST_F(LobesSideBySide, ShowNoSeam) {
    for (const auto& [first, second] : seen_at_the_seam(0)) {
        EXPECT_GT(first[0], 0);
        EXPECT_LT((first - second).abs().maxCoeff(), 1e-5F * first.maxCoeff());
    }
}

TEST_F(LobesSideBySide, OfOtherMaterialsStayApart) {
    for (const auto& [first, second] : seen_at_the_seam(1))
        EXPECT_GT(first[0], 3 * second[0]);
}

TEST_F(LobeTextures, AreNotNeededWithoutGloss) {
    transport.space = RadianceSpace({transport.space.element(0)});
    LobeSynthesis lobes(transport);
    EXPECT_FALSE(lobes.is_needed());
    lobes.take(PackedField::Ones(4, transport.space.functions()));
    EXPECT_EQ(lobes.synthesise(Vec3(1, 1, 1)), 0u);
}

}  // namespace
}  // namespace lightwell
