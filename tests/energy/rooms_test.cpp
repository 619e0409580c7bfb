// Rooms of which the light is known exactly.
#include "tests/unit/reference/rooms.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "solver/reading/scene_reader.h"
#include "solver/reading/wall_cutting.h"
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

/// A hall of one quad a wall, parted into two closed rooms by a wall at x = 3.3 m of this
/// thickness [m].
Scene parted_hall(double thickness) {
    std::array<Rgb, 6> reflectance;
    reflectance.fill(Rgb::Constant(0.5));
    Scene scene = box_scene({8, 4, 3}, reflectance);
    if (thickness > 0)
        add_block(scene, {3.3, 0, 0}, {3.3 + thickness, 4, 3}, Rgb::Constant(0.5));
    else
        add_quad(scene, {{Vec3(3.3, 0, 0), Vec3(3.3, 4, 0), Vec3(3.3, 4, 3), Vec3(3.3, 0, 3)}},
                 Rgb::Constant(0.5));
    return scene;
}

/// The largest irradiance of a cell in the second room, as a share of the mean in the first.
double leak_into_second_room(const Scene& scene) {
    const SolvedScene solved = testing::solved_scene(scene, {lamp_at({1.5, 2, 1.5})}, 0.05);
    double worst = 0, flux = 0, area = 0;
    for (std::size_t e = 0; e < solved.transport.space.elements().size(); ++e) {
        const Element& element = solved.transport.space.element(e);
        const Vec3 before = element.geometry.centre() + 1e-3 * element.geometry.normal();
        if (before[0] > 3.3) {
            worst = std::max(worst, solved.total(e).abs().maxCoeff());
        } else {
            flux += element.area() * solved.mean_indirect(e)[0];
            area += element.area();
        }
    }
    return worst / (flux / area);
}

// Floor, ceiling and long walls pass through both rooms.
TEST(PartedHall, IsDarkBehindTheWallOnceItIsCutAlongIt) {
    for (const double thickness : {0.0, 0.1}) {
        SCOPED_TRACE(thickness);
        Scene scene = parted_hall(thickness);
        scene.quads = cut_along_walls(scene.quads).quads;
        EXPECT_LT(leak_into_second_room(scene), 1e-6);
    }
    // Without the cut, cells lie on both sides of the wall.
    EXPECT_GT(leak_into_second_room(parted_hall(0)), 1e-3);
}

/// A room with a block and four colours of grey.
Scene furnished() {
    std::array<Rgb, 6> reflectance;
    for (std::size_t w = 0; w < 6; ++w)
        reflectance[w] = Rgb::Constant(0.3 + 0.1 * static_cast<double>(w));
    Scene scene = box_scene({4, 3, 2.5}, reflectance);
    add_block(scene, {1, 1, 0}, {2, 2, 1}, Rgb::Constant(0.6));
    for (Material& material : scene.materials)
        material.reflecting = Sides::front;
    return scene;
}

TEST(Frame, TurningAndMovingARoomChangesNothing) {
    const Vec3 lamp(3, 1, 2);
    const SolvedScene plain = testing::solved_scene(furnished(), {lamp_at(lamp)}, 0.05);
    const Eigen::Affine3d by = Eigen::Translation3d(1000, -1000, 500) *
                               Eigen::AngleAxisd(37 * M_PI / 180, Vec3(1, 2, 3).normalized());
    Scene scene = furnished();
    for (SceneQuad& q : scene.quads)
        for (Vec3& v : q.quad.vertex)
            v = by * v;
    const SolvedScene moved = testing::solved_scene(scene, {lamp_at(by * lamp)}, 0.05);
    ASSERT_EQ(moved.transport.space.functions(), plain.transport.space.functions());
    const RadianceField& a = plain.lighting.indirect;
    const RadianceField& b = moved.lighting.indirect;
    EXPECT_LT((a - b).matrix().norm(), 1e-5 * a.matrix().norm());
    EXPECT_LT((plain.lighting.direct - moved.lighting.direct).matrix().norm(),
              1e-6 * plain.lighting.direct.matrix().norm());
}

TEST(Reciprocity, LampAndSensorChangePlaces) {
    const SolvedScene room = testing::solved_scene(furnished(), {}, 0.05);
    const auto n = static_cast<Eigen::Index>(room.transport.space.functions());
    const Eigen::ArrayXd rho = reflectance_of(room.transport.scene, room.transport.space).col(0);
    // Light put on one wall and read on another, both ways: rho_s A_s G_rs = rho_r A_r G_sr.
    const auto exchanged = [&](std::size_t from, std::size_t to, bool solved) {
        RadianceField source = RadianceField::Zero(n, 3);
        const std::uint32_t s = room.transport.space.element(from).first;
        source.row(s).setConstant(1);
        const RadianceField light =
            solved ? solved_light(room.transport, source) : gathered_light(room.transport, source);
        const std::uint32_t r = room.transport.space.element(to).first;
        return light(r, 0) * rho[r];
    };
    for (const std::size_t from : {0U, 3U, 7U})
        for (const std::size_t to : {1U, 4U, 10U}) {
            const double forth = exchanged(from, to, true), back = exchanged(to, from, true);
            EXPECT_NEAR(forth, back, 1e-5 * std::abs(forth) + 1e-9) << from << " to " << to;
            const double stored = exchanged(from, to, false);
            EXPECT_NEAR(stored, exchanged(to, from, false), 0.05 * std::abs(stored) + 1e-6);
        }
}

}  // namespace
}  // namespace lightwell
