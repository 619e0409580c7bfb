// The empty box without truncation against the exact piecewise-constant Galerkin solution.
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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

class BoxGalerkin : public ::testing::TestWithParam<int> {};

TEST_P(BoxGalerkin, SolutionIsTheExactOne) {
    std::ifstream file(std::string(LIGHTWELL_SHARED) + "/reference/box_galerkin.json");
    if (!file) GTEST_SKIP() << "reference data is not here";
    const int level = GetParam();
    const CellTree tree(std::vector<Split>(static_cast<std::size_t>(level), Split::both));
    const auto side = static_cast<std::uint32_t>(1 << level);
    const nlohmann::json boxes = nlohmann::json::parse(file);
    for (const auto& [name, box] : boxes.items()) {
        SCOPED_TRACE(name);
        const nlohmann::json& exact = box["levels"][std::to_string(level)];
        const std::vector<Quad> walls = testing::box_walls(rgb(box["dims"]).matrix());
        std::vector<Rgb> reflectance;
        std::vector<RadianceField> direct(6, RadianceField(side * side, 3));
        for (std::size_t wall = 0; wall < 6; ++wall) {
            reflectance.push_back(rgb(box["rho"][wall]));
            for (std::uint32_t i = 0; i < side; ++i)
                for (std::uint32_t j = 0; j < side; ++j)
                    direct[wall].row(cell_at(tree, wall, i, j)) =
                        rgb(exact["E_direct_patch_mean"][(wall * side + i) * side + j]).transpose();
        }
        const auto solution = testing::solve_uniform(walls, level, reflectance, direct);
        for (std::size_t wall = 0; wall < 6; ++wall) {
            for (int c = 0; c < 3; ++c) {
                const double mean = reflectance[wall][c] * solution[wall].col(c).mean();
                const auto wanted = exact["B_wall_mean"][wall_names[wall]][c].get<double>();
                EXPECT_NEAR(mean, wanted, 1e-4 * wanted) << wall_names[wall] << " channel " << c;
                for (std::uint32_t i = 0; i < side; ++i) {
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

INSTANTIATE_TEST_SUITE_P(Levels, BoxGalerkin, ::testing::Values(0, 1, 2));

}  // namespace
}  // namespace lightwell
