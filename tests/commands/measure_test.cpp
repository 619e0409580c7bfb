#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "radiance4d/scene/quad.h"
#include "tests/commands/program.h"

namespace lightwell {
namespace {

using Words = std::vector<std::string>;

constexpr const char* header =
    "x,y,z,nx,ny,nz,direct_r,direct_g,direct_b,indirect_r,indirect_g,indirect_b,lux\n";

/// The faces of the box [0,x] x [0,y] x [0,z], seen from inside.
std::string box_obj(double x, double y, double z) {
    std::string text;
    for (const double c : {0.0, z})
        for (const double b : {0.0, y})
            for (const double a : {0.0, x})
                text += fmt::format("v {} {} {}\n", a, b, c);
    return text + "f 1 2 4 3\nf 5 7 8 6\nf 1 3 7 5\nf 2 6 8 4\nf 1 5 6 2\nf 3 4 8 7\n";
}

std::string scene_toml(double reflectance, const std::string& light) {
    return fmt::format(
        "geometry = \"room.obj\"\ndefault_material = \"all\"\n[material.all]\nreflectance = {}\n{}",
        reflectance, light);
}

std::string point_light(const std::string& position, double intensity) {
    return fmt::format(
        "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = {}\nintensity = {:.17g}\n",
        position, intensity);
}

/// n x n sensors in the middles of equal cells of one wall of the box of the given size.
struct Wall {
    int axis;       ///< 0, 1, 2: its normal is along x, y, z
    bool far_side;  ///< at the end of that axis
};
std::string wall_sensors(const Wall& wall, const std::array<double, 3>& size, int n) {
    std::string rows;
    const auto axis = static_cast<std::size_t>(wall.axis);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            std::array<double, 3> p{}, normal{};
            p[axis] = wall.far_side ? size[axis] : 0;
            normal[axis] = wall.far_side ? -1 : 1;
            const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
            p[b] = (i + 0.5) / n * size[b];
            p[c] = (j + 0.5) / n * size[c];
            rows += fmt::format("{},{},{},{},{},{}\n", p[0], p[1], p[2], normal[0], normal[1],
                                normal[2]);
        }
    return rows;
}

Table measured(const ScratchFolder& folder, const std::string& operator_file,
               const std::string& sensors, Words more = {}) {
    Words words = {"measure", operator_file, "--sensors", folder.write("sensors.csv", sensors)};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramRun run = lightwell(words);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out.rfind(header, 0), 0u) << run.out;
    return table_from(run.out);
}

double mean(const Table& table, const std::string& column) {
    double sum = 0;
    for (const auto& row : table)
        sum += row.at(column);
    return sum / static_cast<double>(table.size());
}

// CIE 171:2006, 5.2: a point source 3 m above a plane; closed form I cos / d^2.
TEST(Measure, PointSourceAboveABlackFloorFollowsTheInverseSquareLaw) {
    const ScratchFolder folder;
    folder.write("room.obj", "v -5 -5 0\nv 5 -5 0\nv 5 5 0\nv -5 5 0\nf 1 2 3 4\n");
    const std::string scene =
        folder.write("scene.toml", scene_toml(0, point_light("[0, 0, 3]", 1000)));
    const std::string file = precomputed(folder, scene);
    std::string sensors;
    for (const double x : {0.0, 0.5, 1.0, 1.5})
        for (const double y : {0.0, 0.5, 1.0, 1.5})
            sensors += fmt::format("{},{},0,0,0,1\n", x, y);
    for (const auto& row : measured(folder, file, sensors)) {
        const double squared = row.at("x") * row.at("x") + row.at("y") * row.at("y") + 9;
        const double expected = 1000 * 3 / std::pow(squared, 1.5);
        EXPECT_NEAR(row.at("direct_g"), expected, 1e-8 * expected);
        EXPECT_NEAR(row.at("lux"), expected, 1e-8 * expected);
        EXPECT_EQ(row.at("indirect_r"), 0);
    }
}

// CIE 171:2006, 5.4: all of a lamp's flux arrives on the black walls of a room.
TEST(Measure, FluxOfALampArrivesOnTheWalls) {
    const ScratchFolder folder;
    const std::array<double, 3> size = {4, 4, 3};
    folder.write("room.obj", box_obj(size[0], size[1], size[2]));
    const std::string file = precomputed(
        folder,
        folder.write("scene.toml", scene_toml(0, point_light("[2, 2, 1.5]", 10000 / (4 * M_PI)))));
    double flux = 0;
    for (int axis = 0; axis < 3; ++axis)
        for (const bool far_side : {false, true}) {
            const auto a = static_cast<std::size_t>(axis);
            const double area = size[(a + 1) % 3] * size[(a + 2) % 3];
            const Table table =
                measured(folder, file, wall_sensors({axis, far_side}, size, 40), {"--no-gather"});
            flux += area * mean(table, "direct_g");
            EXPECT_EQ(mean(table, "indirect_g"), 0);
        }
    // The midpoint rule's own error with 40 x 40 points a wall is below 2e-4.
    EXPECT_NEAR(flux, 10000, 2);
}

/// Light by way of a floor [0,4]^2 of albedo rho, from a lamp over it, on a wall in the plane x =
/// 0.
double by_way_of_the_floor(double rho, const Vec3& lamp, double candela, const Vec3& sensor) {
    constexpr int steps = 4000;
    constexpr double step = 4.0 / steps;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const Vec3 y((i + 0.5) * step, (j + 0.5) * step, 0);
            const Vec3 to_lamp = lamp - y, to_sensor = sensor - y;
            const double e = candela * to_lamp[2] / std::pow(to_lamp.norm(), 3);
            sum += e * to_sensor[2] * y[0] / std::pow(to_sensor.squaredNorm(), 2);
        }
    return rho / M_PI * sum * step * step;
}

// The spot that a lamp lights from 4 cm is smaller than a cell, and the sensor is as near to it.
TEST(Measure, LampsCloseToASurfaceAreExactThere) {
    const ScratchFolder folder;
    folder.write("two.obj",
                 "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 0 0 3\nv 0 4 3\n"
                 "usemtl floor\nf 1 2 3 4\nusemtl wall\nf 1 4 6 5\n");
    const std::string scene = folder.write(
        "two.toml",
        "geometry = \"two.obj\"\n[material.floor]\nreflectance = 0.5\n[material.wall]\n"
        "reflectance = 0.001\n[[light]]\nname = \"lamp\"\ntype = \"point\"\n"
        "position = [0.15, 2.03, 0.04]\nintensity = 10\n");
    const std::string file = folder / "two.gto";
    ASSERT_EQ(
        lightwell({"precompute", scene, "-o", file, "--error", "0.1", "--attempts", "0"}).status,
        0);
    for (const double height : {0.05, 0.1, 0.5}) {
        const Vec3 sensor(0, 2, height);
        const double exact = by_way_of_the_floor(0.5, {0.15, 2.03, 0.04}, 10, sensor);
        const double read =
            measured(folder, file, fmt::format("0,2,{},1,0,0\n", height))[0].at("indirect_g");
        EXPECT_NEAR(read, exact, 0.03 * exact) << height;
    }
}

// CIE 171:2006, 5.8: mean indirect illuminance of an integrating cube, Phi rho / (S (1 - rho)).
class IntegratingCube : public ::testing::TestWithParam<double> {};

TEST_P(IntegratingCube, HasTheIndirectLightOfTheClosedForm) {
    const double reflectance = GetParam(), flux = 10000, surface = 96;
    const ScratchFolder folder;
    const std::array<double, 3> size = {4, 4, 4};
    folder.write("room.obj", box_obj(4, 4, 4));
    const std::string scene = folder.write(
        "scene.toml", scene_toml(reflectance, point_light("[2, 2, 2]", flux / (4 * M_PI))));
    const std::string file = precomputed(folder, scene, "0.02");
    std::string sensors;
    for (int axis = 0; axis < 3; ++axis)
        for (const bool far_side : {false, true})
            sensors += wall_sensors({axis, far_side}, size, 16);
    const double expected = flux * reflectance / (surface * (1 - reflectance));
    EXPECT_NEAR(mean(measured(folder, file, sensors), "indirect_g"), expected, 3e-3 * expected);
}

INSTANTIATE_TEST_SUITE_P(Reflectances, IntegratingCube,
                         ::testing::Values(0.2, 0.5, 0.8, 0.9, 0.95));

/// The Cornell box, precomputed once for the tests below.
class MeasuredCornellBox : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = new ScratchFolder;
        file_ = precomputed(*folder_, sample_scene("cornell-box"), "0.1");
    }
    static void TearDownTestSuite() { delete folder_; }

    static ScratchFolder* folder_;
    static std::string file_;
};
ScratchFolder* MeasuredCornellBox::folder_ = nullptr;
std::string MeasuredCornellBox::file_;

TEST_F(MeasuredCornellBox, AgreesWithTheExpectedValuesOfTheScene) {
    const std::string expected_csv =
        std::filesystem::path(sample_scene("cornell-box")).parent_path() / "expected.csv";
    const Table expected = table_from(contents(expected_csv));
    std::string sensors;
    for (const auto& row : expected)
        sensors += fmt::format("{},{},{},{},{},{}\n", row.at("x"), row.at("y"), row.at("z"),
                               row.at("nx"), row.at("ny"), row.at("nz"));
    const Table table = measured(*folder_, file_, sensors);
    ASSERT_EQ(table.size(), expected.size());
    for (std::size_t k = 0; k < table.size(); ++k) {
        for (const char* column : {"x", "y", "z", "nx", "ny", "nz"})
            EXPECT_EQ(table[k].at(column), expected[k].at(column));
        for (const char* column : {"direct_r", "direct_g", "direct_b"})
            EXPECT_NEAR(table[k].at(column), expected[k].at(column), 1e-3 * expected[k].at(column))
                << column << " of " << k;
        // Asked for is 10 % over all surfaces; the gather does better.
        EXPECT_NEAR(table[k].at("lux"), expected[k].at("lux"), 0.05 * expected[k].at("lux"));
        EXPECT_NEAR(table[k].at("lux"),
                    0.2126 * (table[k].at("direct_r") + table[k].at("indirect_r")) +
                        0.7152 * (table[k].at("direct_g") + table[k].at("indirect_g")) +
                        0.0722 * (table[k].at("direct_b") + table[k].at("indirect_b")),
                    1e-6 * table[k].at("lux"));
    }
}

TEST_F(MeasuredCornellBox, IsTheSameForAnyNumberOfThreads) {
    const Words words = {"measure", file_, "--grid", "floor", "--threads"};
    Words one = words, many = words;
    one.push_back("1");
    many.push_back("4");
    const ProgramRun first = lightwell(one);
    EXPECT_EQ(first.status, 0) << first.err;
    EXPECT_EQ(first.out, lightwell(many).out);
}

TEST_F(MeasuredCornellBox, GridsOfTheSceneAreMeasuredByName) {
    const ProgramRun run = lightwell({"measure", file_, "--grid", "floor"});
    ASSERT_EQ(run.status, 0) << run.err;
    const Table table = table_from(run.out);
    ASSERT_EQ(table.size(), 100u);
    EXPECT_NEAR(table[0].at("x"), 0.55, 1e-12);
    EXPECT_NEAR(table[1].at("x"), 1.05, 1e-12);
    EXPECT_NEAR(table[10].at("y"), 0.95, 1e-12);

    const ProgramRun wrong = lightwell({"measure", file_, "--grid", "flor"});
    EXPECT_EQ(wrong.status, 1);
    EXPECT_NE(wrong.err.find("'floor'"), std::string::npos) << wrong.err;
    EXPECT_EQ(lightwell({"measure", file_}).status, 1);
}

TEST_F(MeasuredCornellBox, LightsOfAFileReplaceThoseOfTheScene) {
    const std::string dark = folder_->write("dark.toml", "light = []\n");
    const std::string lamp = folder_->write("lamp.toml", point_light("[2.78, 2.8, 3]", 100));
    const std::string sensor = "2.78,2.8,2,0,0,1\n";
    const double without = measured(*folder_, file_, sensor, {"--lights", dark})[0].at("direct_g");
    const double with = measured(*folder_, file_, sensor, {"--lights", lamp})[0].at("direct_g");
    // The luminaire shines in both; the lamp hangs a metre above the sensor.
    EXPECT_GT(without, 0);
    EXPECT_NEAR(with - without, 100, 1e-5);
}

TEST_F(MeasuredCornellBox, WithoutTheGatherSensorsMustLieOnSurfaces) {
    const std::string on = "1,0.5,0,0,0,1\n", above = "1,0.5,0.3,0,0,1\n",
                      aslant = "1,0.5,0,0,1,1\n";
    EXPECT_EQ(measured(*folder_, file_, on, {"--no-gather"}).size(), 1u);
    for (const std::string& off : {above, aslant}) {
        const ProgramRun run = lightwell(
            {"measure", file_, "--no-gather", "--sensors", folder_->write("off.csv", on + off)});
        EXPECT_EQ(run.status, 1);
        EXPECT_EQ(run.out, "");
        EXPECT_NE(run.err.find("sensor 2 at (1, 0.5, "), std::string::npos) << run.err;
    }
}

TEST_F(MeasuredCornellBox, GatherAndBasisAgreeOverTheBackWall) {
    std::string sensors;
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j)
            sensors += fmt::format("{},5.592,{},0,-1,0\n", (i + 0.5) * 0.275, (j + 0.5) * 0.2744);
    const Table gathered = measured(*folder_, file_, sensors);
    const Table basis = measured(*folder_, file_, sensors, {"--no-gather"});
    double difference = 0, sum = 0;
    for (std::size_t k = 0; k < basis.size(); ++k) {
        EXPECT_EQ(gathered[k].at("direct_g"), basis[k].at("direct_g"));
        difference += std::pow(gathered[k].at("indirect_g") - basis[k].at("indirect_g"), 2);
        sum += std::pow(gathered[k].at("indirect_g"), 2);
    }
    EXPECT_NEAR(mean(basis, "indirect_g"), mean(gathered, "indirect_g"),
                0.02 * mean(gathered, "indirect_g"));
    EXPECT_LT(std::sqrt(difference / sum), 0.1) << "the error that was asked for";
    EXPECT_GT(difference, 0);
}

TEST_F(MeasuredCornellBox, SensorsBesideTheFloorSeeWhatSensorsOnItSee) {
    // Rounded coordinates, on either side of the floor, and just above it.
    const Table table = measured(*folder_, file_,
                                 "1,1.5,0,0,0,1\n1,1.5,0.00001,0,0,1\n1,1.5,-0.00001,0,0,1\n"
                                 "1,1.5,0.001,0,0,1\n");
    for (std::size_t k = 1; k < table.size(); ++k)
        EXPECT_NEAR(table[k].at("lux"), table[0].at("lux"), 2e-3 * table[0].at("lux")) << k;
}

TEST_F(MeasuredCornellBox, AThousandSensorsAreWrittenToAFile) {
    std::string sensors;
    for (int k = 0; k < 1000; ++k)
        sensors += fmt::format("{},{},0,0,0,1\n", 0.3 + 0.005 * k, 0.3 + 0.005 * (k * 37 % 1000));
    const std::string csv = folder_->write("many.csv", sensors);
    const ProgramRun run =
        lightwell({"measure", file_, "--sensors", csv, "-o", *folder_ / "out.csv"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(table_from(contents(*folder_ / "out.csv")).size(), 1000u);
    EXPECT_EQ(run.out, "");
}

TEST_F(MeasuredCornellBox, FilesThatAreNotWhatTheyShouldBeAreRefused) {
    const std::string sensors = folder_->write("good.csv", "1,1,0,0,0,1\n");
    const std::string bad =
        folder_->write("bad.csv", "x,y,z,nx,ny,nz\n1,1,0,0,0,1\n1,1,zero,0,0,1\n");
    const ProgramRun at_row = lightwell({"measure", file_, "--sensors", bad});
    EXPECT_EQ(at_row.status, 1);
    EXPECT_EQ(at_row.err.rfind("lightwell: " + bad + ":3:", 0), 0u) << at_row.err;
    EXPECT_EQ(lightwell({"measure", sensors, "--sensors", sensors}).status, 1);
    EXPECT_EQ(lightwell({"measure", *folder_ / "none.gto", "--sensors", sensors}).status, 1);
    EXPECT_EQ(lightwell({"measure", file_, "--sensors", *folder_ / "none.csv"}).status, 1);
    EXPECT_EQ(lightwell({"measure", file_, "--sensors", sensors, "--lights", sensors}).status, 1);
    std::string bytes = contents(file_);
    const ProgramRun cut =
        lightwell({"measure", folder_->write("cut.gto", bytes.substr(0, bytes.size() / 2)),
                   "--sensors", sensors});
    EXPECT_EQ(cut.status, 1);
    EXPECT_NE(cut.err.find("cut.gto"), std::string::npos) << cut.err;
}

}  // namespace
}  // namespace lightwell
