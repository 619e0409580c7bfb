// No more than needed: what each kind of scene pays in coefficients and bytes.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "radiance4d/operator/operator_file.h"
#include "tests/scratch_folder.h"
#include "viewer/stability/case_scenes.h"
#include "viewer/stability/lit_scene.h"

namespace lightwell::stability {
namespace {

/// What one scene pays.
struct Price {
    std::uint64_t cells = 0, functions = 0;  ///< they differ where light keeps its direction
    std::uint64_t direct = 0;                ///< coefficients of the bounce operator
    std::uint64_t global = 0;                ///< of all channels of H
    std::size_t channels = 0;
    std::uint64_t bytes = 0;  ///< of the file
};

Price price_of(const std::string& kind, const GlobalTransport& transport) {
    Price price;
    for (const Element& element : transport.space.elements())
        price.cells += element.space.tree().functions();
    price.functions = transport.space.functions();
    price.direct = transport.bounce.coefficients();
    for (const TransportOperator& channel : transport.indirect)
        price.global += channel.coefficients();
    price.channels = transport.indirect.size();
    const testing::ScratchFolder folder;
    const std::string file = folder / "scene.gto";
    write_operator_file(file, transport);
    price.bytes = std::filesystem::file_size(file);
    std::printf(
        "%-36s %7llu cells %7llu functions %8llu direct %8llu global %zu channels %8llu B\n",
        kind.c_str(), static_cast<unsigned long long>(price.cells),
        static_cast<unsigned long long>(price.functions),
        static_cast<unsigned long long>(price.direct),
        static_cast<unsigned long long>(price.global), price.channels,
        static_cast<unsigned long long>(price.bytes));
    return price;
}

Price price_of(const std::string& kind, const Scene& scene, double error) {
    return price_of(kind, LitScene(scene, error).transport());
}

Scene with_desk() {
    Scene scene = office();
    add_quad(scene, rectangle({2, 1.5, 0.75}, {1.6, 0, 0}, {0, 0.8, 0}), 0.5);
    return scene;
}

TEST(Needs, GreyScenesStoreOneChannelAndColouredOnesThoseThatDiffer) {
    const Price grey = price_of("grey office, 5 %", with_desk(), 0.05);
    EXPECT_EQ(grey.channels, 1U);
    EXPECT_EQ(grey.functions, grey.cells) << "diffuse surfaces store directions";
    Scene coloured = with_desk();
    coloured.materials[0].reflectance = Rgb(0.6, 0.3, 0.2);
    coloured.materials[1].reflectance = Rgb(0.2, 0.6, 0.3);
    const Price colour = price_of("coloured office, 5 %", coloured, 0.05);
    EXPECT_EQ(colour.channels, 3U);
    EXPECT_EQ(colour.functions, colour.cells);
    // Transport itself has no colour.
    EXPECT_LT(colour.direct, 1.1 * static_cast<double>(grey.direct));
    EXPECT_LT(colour.bytes, 3 * grey.bytes);
}

TEST(Needs, ALargeErrorCostsNextToNothing) {
    const Price small = price_of("grey office, 5 %", with_desk(), 0.05);
    const Price large = price_of("grey office, 20 %", with_desk(), 0.2);
    EXPECT_LT(12 * large.global, small.global);
    EXPECT_LT(8 * large.bytes, small.bytes);
    EXPECT_LT(large.bytes, 100'000U);
}

TEST(Needs, RoomsThatDoNotSeeEachOtherHaveNoLinks) {
    const Price one = price_of("one closed room, 10 %", room({4, 3, 2.5}, 0.5), 0.1);
    Scene ten;
    for (int k = 0; k < 10; ++k) {
        const Scene next =
            moved(room({4, 3, 2.5}, 0.5),
                  Eigen::Affine3d(Eigen::Translation3d(5.0 * (k % 5), 4.0 * (k / 5), 0)));
        for (const SceneQuad& wall : next.quads)
            add_quad(ten, wall.quad, 0.5);
    }
    // Walls that turn their backs to each other, and both sides of all walls reflect.
    for (Material& material : ten.materials)
        material.reflecting = Sides::front;
    const LitScene lit(ten, 0.1);
    const Price all = price_of("ten closed rooms, 10 %", lit.transport());
    const RadianceSpace& space = lit.transport().space;
    const auto room_of = [&](std::uint32_t function) {
        return space.element(space.element_of(function)).quad / 6;
    };
    const auto crossing = [&](const TransportOperator& op) {
        std::uint64_t count = 0;
        for (std::uint32_t column = 0; column < op.size; ++column)
            for (std::uint64_t k = op.column_start[column]; k < op.column_start[column + 1]; ++k)
                count += room_of(op.row[k]) != room_of(column) ? 1 : 0;
        return count;
    };
    EXPECT_EQ(crossing(lit.transport().bounce.upper), 0U);
    EXPECT_EQ(crossing(lit.transport().indirect[0]), 0U);
    EXPECT_LT(all.global, 15 * one.global);
}

TEST(Needs, OnlyAGlossyQuadStoresDirections) {
    const Price diffuse = price_of("grey office, 10 %", with_desk(), 0.1);
    Scene scene = with_desk();
    PhongLobe lobe;
    lobe.reflectance.setConstant(0.3);
    lobe.exponent = 10;
    scene.materials.back().lobe = lobe;
    const LitScene lit(scene, 0.1);
    const Price glossy = price_of("the same with a glossy desk, 10 %", lit.transport());
    for (const Element& element : lit.transport().space.elements())
        EXPECT_EQ(element.angle.functions() > 1, element.quad == 6) << "quad " << element.quad;
    EXPECT_LT(glossy.bytes, 10 * diffuse.bytes);
}

}  // namespace
}  // namespace lightwell::stability
