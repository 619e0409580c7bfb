// The empty box without truncation against the exact piecewise-constant Galerkin solution.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "radiance4d/operator/light_projection.h"
#include "tests/shared_reference.h"
#include "tests/unit/transport/box.h"

namespace lightwell {
namespace {

const char* const wall_names[] = {"x0", "x1", "y0", "y1", "z0_floor", "z1_ceiling"};

Rgb rgb(const nlohmann::json& values) {
    return {values[0].get<double>(), values[1].get<double>(), values[2].get<double>()};
}

/// The cell of a wall at the reference's indices along its first and second tangential axis. Walls
/// x1, y0 and the ceiling run the other way round so that their normals point inwards: u and v
/// change places.
std::uint32_t cell_at(const CellTree& tree, std::size_t wall, std::uint32_t first,
                      std::uint32_t second) {
    const bool swapped = wall == 1 || wall == 2 || wall == 5;
    return swapped ? tree.finest_at(second, first) : tree.finest_at(first, second);
}

/// Mean direct irradiance of every cell from the lamps of a reference box.
std::vector<RadianceField> projected(const std::vector<Quad>& walls, int level,
                                     const nlohmann::json& lamps) {
    std::vector<Light> lights;
    for (const nlohmann::json& lamp : lamps)
        lights.push_back(PointLight{"lamp", rgb(lamp[0]).matrix(), rgb(lamp[1])});
    const RadianceSpace space(testing::uniform_elements(walls, level));
    const RadianceField field = projected_lights(space, lights, walls, OccluderTree(walls));
    std::vector<RadianceField> direct;
    for (std::size_t e = 0; e < walls.size(); ++e)
        direct.push_back(cell_irradiance(space, e, field));
    return direct;
}

class BoxGalerkin : public ::testing::TestWithParam<int> {};

TEST_P(BoxGalerkin, SolutionIsTheExactOne) {
    LIGHTWELL_SHARED_JSON(boxes, "reference/box_galerkin.json");
    const int level = GetParam();
    const CellTree tree(std::vector<Split>(static_cast<std::size_t>(level), Split::both));
    const auto side = static_cast<std::uint32_t>(1 << level);
    for (const auto& [name, box] : boxes.items()) {
        SCOPED_TRACE(name);
        const nlohmann::json& exact = box["levels"][std::to_string(level)];
        const std::vector<Quad> walls = testing::box_walls(rgb(box["dims"]).matrix());
        // The finer levels come with wall means only.
        const bool patches = exact.contains("B_patch");
        std::vector<Rgb> reflectance;
        std::vector<RadianceField> direct(6, RadianceField(side * side, 3));
        for (std::size_t wall = 0; wall < 6; ++wall) {
            reflectance.push_back(rgb(box["rho"][wall]));
            for (std::uint32_t i = 0; patches && i < side; ++i)
                for (std::uint32_t j = 0; j < side; ++j)
                    direct[wall].row(cell_at(tree, wall, i, j)) =
                        rgb(exact["E_direct_patch_mean"][(wall * side + i) * side + j]).transpose();
        }
        if (!patches) direct = projected(walls, level, box["lights"]);
        const auto solution = testing::solve_uniform(walls, level, reflectance, direct);
        for (std::size_t wall = 0; wall < 6; ++wall) {
            for (int c = 0; c < 3; ++c) {
                const double mean = reflectance[wall][c] * solution[wall].col(c).mean();
                const auto wanted = exact["B_wall_mean"][wall_names[wall]][c].get<double>();
                EXPECT_NEAR(mean, wanted, 1e-4 * wanted) << wall_names[wall] << " channel " << c;
                for (std::uint32_t i = 0; patches && i < side; ++i) {
                    for (std::uint32_t j = 0; j < side; ++j) {
                        const double patch =
                            reflectance[wall][c] * solution[wall](cell_at(tree, wall, i, j), c);
                        const auto b =
                            exact["B_patch"][(wall * side + i) * side + j][c].get<double>();
                        EXPECT_NEAR(patch, b, 1e-3 * b)
                            << wall_names[wall] << " patch " << i << "," << j << " channel " << c;
                    }
                }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Levels, BoxGalerkin, ::testing::Values(0, 1, 2, 3));

}  // namespace
}  // namespace lightwell
