#include "runtime/outgoing/texture_synthesis.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

Quad rectangle(double x, double y, double width, double depth) {
    return {{Vec3(x, y, 0), Vec3(x + width, y, 0), Vec3(x + width, y + depth, 0),
             Vec3(x, y + depth, 0)}};
}

/// Two floors side by side, with 4 x 4 cells of the same size, and a wall at their far end. H has
/// one coefficient in every row, so that all levels are needed.
GlobalTransport two_floors(const std::vector<OpenMask>& open = {},
                           const Quad& wall = {
                               {Vec3(0, 1, 0), Vec3(2, 1, 0), Vec3(2, 1, 2), Vec3(0, 1, 2)}}) {
    std::vector<Element> elements(3);
    elements[0].geometry = rectangle(0, 0, 1, 1);
    elements[1].geometry = rectangle(1, 0, 1, 1);
    elements[2].geometry = wall;
    for (int e = 0; e < 3; ++e) {
        Element& element = elements[static_cast<std::size_t>(e)];
        element.quad = e;
        element.set_space(CellTree(std::vector<Split>(2, Split::both)),
                          e == 0 ? open : std::vector<OpenMask>());
    }
    GlobalTransport transport;
    transport.space = RadianceSpace(elements);
    TransportOperator h;
    h.size = transport.space.functions();
    for (std::uint32_t j = 0; j < h.size; ++j) {
        h.column_start.push_back(j);
        h.row.push_back(j);
        h.value.push_back(1);
    }
    h.column_start.push_back(h.size);
    transport.indirect = {h};
    return transport;
}

/// A field of illuminance that is a function of the place.
template <typename Function>
PackedField field_of(const RadianceSpace& space, const Function& lux) {
    RadianceField field = RadianceField::Zero(space.functions(), 3);
    for (std::size_t e = 0; e < space.elements().size(); ++e) {
        const CellTree& tree = space.element(e).space.tree();
        RadianceField means(tree.functions(), 3);
        for (std::uint32_t m = 0; m < tree.functions(); ++m)
            means.row(m) =
                lux(space.element(e).cell({tree.levels(), m}).centre()) * Rgb(1, 2, 3).transpose();
        set_cell_irradiance(space, e, means, field);
    }
    return packed(field);
}

double bumpy(const Vec3& p) {
    return 5 + std::sin(7 * p[0]) + std::cos(5 * p[1]) + p[2];
}

TEST(TextureSynthesis, TexelsAreTheMeansOfCells) {
    const GlobalTransport transport = two_floors();
    TextureSynthesis synthesis(transport);
    const PackedField field = field_of(transport.space, bumpy);
    EXPECT_EQ(synthesis.synthesise(field), 3U);
    for (std::size_t e = 0; e < 3; ++e) {
        const RadianceField means = cell_irradiance(transport.space, e, unpacked(field));
        const CellTree& tree = transport.space.element(e).space.tree();
        ASSERT_EQ(synthesis.atlas().place(e).size.columns, static_cast<int>(tree.columns()));
        for (std::uint32_t j = 0; j < tree.rows(); ++j)
            for (std::uint32_t i = 0; i < tree.columns(); ++i)
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(static_cast<double>(synthesis.atlas().texel(
                                    e, static_cast<int>(i), static_cast<int>(j))[c]),
                                means(tree.finest_at(i, j), c), 1e-5 * means.maxCoeff());
    }
}

TEST(TextureSynthesis, IsNoFinerThanTheOperator) {
    GlobalTransport transport = two_floors();
    // Leave out all rows of the middle element but those of its scaling function and one wavelet of
    // the whole.
    TransportOperator& h = transport.indirect[0];
    const std::uint32_t first = transport.space.element(1).first;
    for (std::uint32_t& row : h.row)
        if (row >= first + 2 && row < transport.space.element(2).first) row = first + 1;
    TextureSynthesis synthesis(transport);
    EXPECT_EQ(synthesis.level(0), 2);
    EXPECT_EQ(synthesis.level(1), 1);
    EXPECT_EQ(synthesis.atlas().place(1).size.columns, 2);
    EXPECT_EQ(synthesis.atlas().place(1).size.rows, 2);
}

TEST(TextureSynthesis, OnlyWhatChangedIsSynthesised) {
    const GlobalTransport transport = two_floors();
    TextureSynthesis synthesis(transport);
    PackedField field = field_of(transport.space, bumpy);
    EXPECT_EQ(synthesis.synthesise(field), 3U);
    EXPECT_EQ(synthesis.synthesise(field), 0U);
    field.col(transport.space.element(1).first) *= 1.5F;
    EXPECT_EQ(synthesis.synthesise(field), 1U);
}

TEST(TextureSynthesis, AfterAnyChangesTheTexturesAreAsIfMadeAnew) {
    const GlobalTransport transport = two_floors();
    TextureSynthesis synthesis(transport);
    PackedField field = field_of(transport.space, bumpy);
    std::mt19937 random(5);
    for (int k = 0; k < 20; ++k) {
        field.col(static_cast<Eigen::Index>(random() % transport.space.functions())) *= 0.7F;
        synthesis.synthesise(field);
    }
    TextureSynthesis anew(transport);
    anew.synthesise(field);
    const TextureSize& size = anew.atlas().size();
    for (int k = 0; k < 4 * size.columns * size.rows; ++k)
        ASSERT_EQ(synthesis.atlas().pixels()[k], anew.atlas().pixels()[k]) << k;
}

TEST(TextureSynthesis, NoEdgeShowsBetweenCoplanarQuads) {
    const GlobalTransport transport = two_floors();
    TextureSynthesis synthesis(transport);
    synthesis.synthesise(field_of(transport.space, bumpy));
    for (double v = 0.01; v < 1; v += 0.07) {
        const Packed left = synthesis.atlas().bilinear(0, 1, v);
        const Packed right = synthesis.atlas().bilinear(1, 0, v);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(left[c], right[c], 1e-5F * left[c]) << "at v = " << v;
    }
}

TEST(TextureSynthesis, LightDoesNotPassAWallBetweenCoplanarQuads) {
    const Quad wall{{Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 2), Vec3(1, 0, 2)}};
    const GlobalTransport transport = two_floors({}, wall);
    TextureSynthesis synthesis(transport);
    synthesis.synthesise(
        field_of(transport.space, [](const Vec3& p) { return p[0] < 1 ? 9.0 : 2.0; }));
    for (double v = 0.01; v < 1; v += 0.07) {
        EXPECT_NEAR(synthesis.atlas().bilinear(0, 1, v)[0], 9.0F, 1e-4F) << v;
        EXPECT_NEAR(synthesis.atlas().bilinear(1, 0, v)[0], 2.0F, 1e-4F) << v;
    }
}

TEST(TextureSynthesis, LinearLightIsLinearToTheRim) {
    const GlobalTransport transport = two_floors();
    TextureSynthesis synthesis(transport);
    const auto linear = [](const Vec3& p) { return 10 + 2 * p[0] - 3 * p[1] + p[2]; };
    synthesis.synthesise(field_of(transport.space, linear));
    for (std::size_t e = 0; e < 3; ++e)
        for (const double u : {0.0, 0.05, 0.5, 1.0})
            for (const double v : {0.0, 0.33, 0.97, 1.0}) {
                const double wanted = linear(transport.space.element(e).geometry.point(u, v));
                EXPECT_NEAR(static_cast<double>(synthesis.atlas().bilinear(e, u, v)[0]), wanted,
                            1e-4)
                    << "element " << e << " at " << u << ' ' << v;
            }
}

TEST(TextureSynthesis, BuriedCellsTakeTheLightAround) {
    std::vector<OpenMask> open(16, all_open);
    const CellTree tree(std::vector<Split>(2, Split::both));
    open[tree.finest_at(1, 1)] = 0;
    const GlobalTransport transport = two_floors(open);
    TextureSynthesis synthesis(transport);
    synthesis.synthesise(field_of(transport.space, [](const Vec3& p) {
        return (p - Vec3(0.375, 0.375, 0)).norm() < 0.1 ? 0.0 : 7.0;
    }));
    EXPECT_NEAR(synthesis.atlas().texel(0, 1, 1)[0], 7.0F, 0.05F);
}

TEST(TextureSynthesis, DeepInAGapItIsDark) {
    std::vector<OpenMask> open(16, 0);
    const CellTree tree(std::vector<Split>(2, Split::both));
    for (const std::uint32_t row : {0U, 1U, 2U, 3U})
        open[tree.finest_at(0, row)] = all_open;
    const GlobalTransport transport = two_floors(open);
    TextureSynthesis synthesis(transport);
    // Light that no one sees in the last two columns must not show either.
    synthesis.synthesise(field_of(transport.space, [](const Vec3&) { return 7.0; }));
    for (int row = 0; row < 4; ++row) {
        for (const int column : {0, 1, 2})
            EXPECT_NEAR(synthesis.atlas().texel(0, column, row)[0], 7.0F, 1e-4F) << column;
        EXPECT_EQ(synthesis.atlas().texel(0, 3, row)[0], 0.0F);
    }
}

}  // namespace
}  // namespace lightwell
