// Rooms of which the light is known exactly.
#include "tests/unit/reference/rooms.h"

#include <cmath>

#include <gtest/gtest.h>

#include "solver/reading/scene_reader.h"
#include "tests/energy/solved_scene.h"
#include "tests/shared_reference.h"
#include "tests/unit/transport/box.h"

namespace lightwell {
namespace {

using testing::SolvedScene;

const std::array<const char*, 6> wall_names{"x0", "x1", "y0", "y1", "z0_floor", "z1_ceiling"};

Rgb rgb(const nlohmann::json& values) {
    return {values.at(0).get<double>(), values.at(1).get<double>(), values.at(2).get<double>()};
}

TEST(BoxContinuous, WallMeansAreTheContinuousOnes) {
    LIGHTWELL_SHARED_JSON(rooms, "reference/box_continuous.json");
    for (const nlohmann::json& room : rooms) {
        SCOPED_TRACE(room.at("name").get<std::string>());
        std::array<Rgb, 6> reflectance;
        for (std::size_t w = 0; w < 6; ++w)
            reflectance[w] = rgb(room.at("walls").at(wall_names[w]).at("rho"));
        std::vector<Light> lights;
        for (const nlohmann::json& light : room.at("lights"))
            lights.push_back(lamp_at(rgb(light.at("pos")).matrix(), rgb(light.at("I"))));
        const SolvedScene solved = testing::solved_scene(
            box_scene(rgb(room.at("dims")).matrix(), reflectance), lights, 0.02);
        double worst = 0;
        for (int w = 0; w < 6; ++w) {
            const auto element =
                static_cast<std::size_t>(solved.transport.space.element_on(w, true));
            const auto name = wall_names[static_cast<std::size_t>(w)];
            const Rgb wanted = rgb(room.at("walls").at(name).at("E_indirect_mean"));
            const Rgb off = (solved.mean_indirect(element) / wanted - 1).abs();
            worst = std::max(worst, off.maxCoeff());
            EXPECT_LT(off.maxCoeff(), 5e-3) << name << ": " << off.transpose();
        }
        RecordProperty("reached_" + room.at("name").get<std::string>(), std::to_string(worst));
    }
}

TEST(Cie58, MeanIndirectIlluminanceForEveryReflectance) {
    LIGHTWELL_SHARED_JSON(cie, "reference/cie171.json");
    double worst = 0;
    for (const nlohmann::json& row : cie.at("5.8_internal_reflected").at("rows")) {
        const auto rho = row.at("rho").get<double>();
        if (rho == 0) continue;
        std::array<Rgb, 6> reflectance;
        reflectance.fill(Rgb::Constant(rho));
        const SolvedScene solved =
            testing::solved_scene(box_scene({4, 4, 4}, reflectance),
                                  {lamp_at({2, 2, 2}, Rgb::Constant(10000 / (4 * M_PI)))}, 0.05);
        const auto wanted = row.at("E_indirect_mean").get<double>();
        EXPECT_NEAR(solved.mean_indirect()[0], wanted, 3e-3 * wanted) << "rho " << rho;
        worst = std::max(worst, std::abs(solved.mean_indirect()[0] / wanted - 1));
    }
    RecordProperty("reached", std::to_string(worst));
}

TEST(Manufactured, ConstantRadiosityIsExactAtEveryLevel) {
    LIGHTWELL_SHARED_JSON(manufactured, "reference/manufactured.json");
    const auto number = [](const nlohmann::json& text) {
        return std::stod(text.get<std::string>());
    };
    for (const nlohmann::json& room : manufactured.at("mms")) {
        SCOPED_TRACE(room.at("name").get<std::string>());
        const Vec3 size(number(room["dims"][0]), number(room["dims"][1]), number(room["dims"][2]));
        for (const int level : {0, 1, 2}) {
            const CellTree tree(std::vector<Split>(static_cast<std::size_t>(level), Split::both));
            // With B = rho X, the equation B = M + rho F B is X = M / rho + F rho X.
            std::vector<Rgb> reflectance;
            std::vector<RadianceField> source(6, RadianceField::Zero(tree.functions(), 3));
            for (std::size_t w = 0; w < 6; ++w)
                reflectance.push_back(Rgb::Constant(number(room["rho"][w])));
            for (const nlohmann::json& patch :
                 room["patch_means"]["level" + std::to_string(level)]) {
                std::size_t w = 0;
                while (patch["wall"] != wall_names[w])
                    ++w;
                const auto i = patch["ij"][0].get<std::uint32_t>();
                const auto j = patch["ij"][1].get<std::uint32_t>();
                const bool swapped = w == 1 || w == 2 || w == 5;
                const std::uint32_t cell = swapped ? tree.finest_at(j, i) : tree.finest_at(i, j);
                source[w].row(cell).setConstant(number(patch["M_mean"]) / reflectance[w][0]);
            }
            const auto solution =
                testing::solve_uniform(testing::box_walls(size), level, reflectance, source);
            for (std::size_t w = 0; w < 6; ++w) {
                const double wanted = number(room["B"][w]);
                EXPECT_LT((solution[w] * reflectance[w][0] - wanted).abs().maxCoeff(),
                          2e-6 * wanted)
                    << wall_names[w] << " level " << level;
            }
        }
    }
}

TEST(TwoRooms, NotAPhotonReachesTheSecond) {
    const Scene scene = read_scene(std::string(LIGHTWELL_SCENES) + "/two-rooms/scene.toml").scene;
    const SolvedScene solved = testing::solved_scene(scene, scene.lights, 0.05);
    double flux = 0, area = 0;
    int dark = 0;
    for (std::size_t e = 0; e < solved.transport.space.elements().size(); ++e) {
        const Element& element = solved.transport.space.element(e);
        const Vec3 before = element.geometry.centre() + 1e-3 * element.geometry.normal();
        const RadianceField cells = solved.total(e);
        if (before[0] > 4) {
            EXPECT_EQ(cells.abs().maxCoeff(), 0) << scene.describe(element.quad);
            ++dark;
        } else {
            flux += element.area() * (solved.mean_indirect(e)[0]);
            area += element.area();
        }
    }
    EXPECT_GE(dark, 6);
    // The balance of energy of the first room; half of the light in it is indirect.
    EXPECT_NEAR(flux / area, 5 * M_PI, 5e-3 * 5 * M_PI);
}

}  // namespace
}  // namespace lightwell
