#include "runtime/outgoing/final_gather.h"

#include <gtest/gtest.h>

#include "radiance4d/operator/smooth_irradiance.h"
#include "radiance4d/scene/form_factor.h"

namespace lightwell {
namespace {

/// A grey ceiling of 8 x 8 cells, 1 m above the origin. Its columns from `first` on are buried.
GlobalTransport ceiling(std::uint32_t first) {
    GlobalTransport transport;
    Material grey;
    grey.reflectance = Rgb::Constant(0.5);
    transport.scene.materials = {grey};
    SceneQuad above;
    above.quad = {{Vec3(-1, -1, 1), Vec3(-1, 1, 1), Vec3(1, 1, 1), Vec3(1, -1, 1)}};
    transport.scene.quads = {above};
    const CellTree tree(std::vector<Split>(3, Split::both));
    std::vector<OpenMask> open(tree.functions(), all_open);
    for (std::uint32_t i = first; i < tree.columns(); ++i)
        for (std::uint32_t j = 0; j < tree.rows(); ++j)
            open[tree.finest_at(i, j)] = 0;
    Element element;
    element.geometry = above.quad;
    element.set_space(tree, open);
    transport.space = RadianceSpace({element});
    return transport;
}

/// Every open cell has 1 lx, what is buried 100: nobody is to see that.
RadianceField lit(const RadianceSpace& space) {
    const Element& element = space.element(0);
    RadianceField means(element.space.tree().functions(), 3);
    for (Eigen::Index m = 0; m < means.rows(); ++m)
        means.row(m).setConstant(element.open[static_cast<std::size_t>(m)] == 0 ? 100 : 1);
    RadianceField field = RadianceField::Zero(space.functions(), 3);
    set_cell_irradiance(space, 0, means, field);
    return field;
}

TEST(SmoothIrradiance, CarriesOnTwoRingsIntoWhatIsBuried) {
    const GlobalTransport transport = ceiling(2);
    const SmoothSurface surface = smooth_irradiance(transport.space, 0, lit(transport.space));
    const auto at_column = [&](int i) { return surface.at((i + 0.5) / 8, 0.3)[0]; };
    for (int i = 0; i < 2; ++i)
        EXPECT_NEAR(at_column(i), 1, 1e-12) << i;
    for (int i = 2; i < 4; ++i)
        EXPECT_NEAR(at_column(i), 1, 0.2) << i;
    for (int i = 4; i < 8; ++i)
        EXPECT_LT(at_column(i), 0.02) << i;
}

TEST(FinalGather, SeesNothingOfWhatIsBuried) {
    for (const std::uint32_t first : {4U, 6U}) {
        const GlobalTransport transport = ceiling(first);
        const Visibility visibility({transport.scene.quads[0].quad});
        const FinalGather gather(transport, visibility,
                                 smooth_irradiance(transport.space, lit(transport.space)), 256);
        // u runs along y.
        const double to = -1 + 2.0 * (first + 1.0 / 8) / 8;  // the gap begins after one sample
        const Quad open{{Vec3(-1, -1, 1), Vec3(-1, to, 1), Vec3(1, to, 1), Vec3(1, -1, 1)}};
        const Rgb wanted = Rgb::Constant(
            0.5 * point_form_factor(Vec3::Zero(), Vec3::UnitZ(), ConvexPolygon(open)));
        EXPECT_LT(
            (gather.irradiance(Vec3::Zero(), Vec3::UnitZ(), -1) / wanted - 1).abs().maxCoeff(),
            5e-3)
            << first;
    }
}

}  // namespace
}  // namespace lightwell
