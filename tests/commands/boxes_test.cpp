// Empty boxes whose light is known as a continuous function, through the program: a scene file, an
// operator file, sensors.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/commands/program.h"
#include "tests/shared_reference.h"

namespace lightwell {
namespace {

using Channels = std::array<double, 3>;

/// A wall of the box by the reference's name for it, the corners of its face in the OBJ file, and
/// the axis that it is square to.
struct Wall {
    const char* name;
    const char* face;
    std::size_t axis;
    bool far_end;
};
constexpr std::array<Wall, 6> walls = {{{"x0", "1 4 8 5", 0, false},
                                        {"x1", "2 6 7 3", 0, true},
                                        {"y0", "1 5 6 2", 1, false},
                                        {"y1", "4 3 7 8", 1, true},
                                        {"z0_floor", "1 2 3 4", 2, false},
                                        {"z1_ceiling", "5 8 7 6", 2, true}}};

/// Gauss and Legendre's rule of eight points on [0,1], along either side of a wall: the mean of a
/// function that bends at the edges takes several times more even points.
constexpr std::array<double, 8> node = {
    0.019855071751231884, 0.10166676129318664, 0.23723379504183551, 0.40828267875217511,
    0.59171732124782489,  0.76276620495816449, 0.89833323870681336, 0.98014492824876812};
constexpr std::array<double, 8> weight = {
    0.050614268145188130, 0.11119051722668724, 0.15685332293894364, 0.18134189168918099,
    0.18134189168918099,  0.15685332293894364, 0.11119051722668724, 0.050614268145188130};

Channels numbers(const nlohmann::json& values) {
    return {values.at(0).get<double>(), values.at(1).get<double>(), values.at(2).get<double>()};
}

std::string list(const Channels& values) {
    return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", values[0], values[1], values[2]);
}

/// Writes geometry and scene of a box. @return path of the scene.
std::string box_scene(const ScratchFolder& folder, const nlohmann::json& box) {
    const Channels size = numbers(box.at("dims"));
    std::string obj, toml = "geometry = \"box.obj\"\n";
    for (const double z : {0.0, size[2]})
        for (const auto& [x, y] : {std::pair{0.0, 0.0}, std::pair{size[0], 0.0},
                                   std::pair{size[0], size[1]}, std::pair{0.0, size[1]}})
            obj += fmt::format("v {} {} {}\n", x, y, z);
    for (const Wall& wall : walls) {
        obj += fmt::format("usemtl {}\nf {}\n", wall.name, wall.face);
        toml += fmt::format("[material.{}]\nreflectance = {}\n", wall.name,
                            list(numbers(box.at("walls").at(wall.name).at("rho"))));
    }
    for (const nlohmann::json& light : box.at("lights"))
        toml += fmt::format(
            "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = {}\nintensity = {}\n",
            list(numbers(light.at("pos"))), list(numbers(light.at("I"))));
    folder.write("box.obj", obj);
    return folder.write("box.toml", toml);
}

std::string sensor(const Channels& at, const Wall& wall) {
    Channels normal{};
    normal[wall.axis] = wall.far_end ? -1 : 1;
    return fmt::format("{:.17g},{:.17g},{:.17g},{},{},{}\n", at[0], at[1], at[2], normal[0],
                       normal[1], normal[2]);
}

/// The reference's points in their order, then those of the rule on every wall.
std::string sensors(const nlohmann::json& box) {
    const Channels size = numbers(box.at("dims"));
    std::string rows;
    for (const nlohmann::json& point : box.at("points"))
        for (const Wall& wall : walls)
            if (point.at("wall") == wall.name) rows += sensor(numbers(point.at("p")), wall);
    for (const Wall& wall : walls)
        for (const double along : node)
            for (const double across : node) {
                Channels at{};
                at[wall.axis] = wall.far_end ? size[wall.axis] : 0;
                const std::size_t u = (wall.axis + 1) % 3, v = (wall.axis + 2) % 3;
                at[u] = along * size[u];
                at[v] = across * size[v];
                rows += sensor(at, wall);
            }
    return rows;
}

constexpr std::array<const char*, 3> indirect = {"indirect_r", "indirect_g", "indirect_b"};
constexpr std::array<const char*, 3> direct = {"direct_r", "direct_g", "direct_b"};

/// What is off, in shares of the root mean square of the box's indirect illuminance, channel by
/// channel: what is asked of an operator is asked in this measure.
struct Off {
    double rms = 0;     ///< over the reference's points
    double inner = 0;   ///< at worst, a tenth of a side and more from the edges
    double edge = 0;    ///< at worst, nearer
    double mean = 0;    ///< of a wall, at worst
    double direct = 0;  ///< at worst, of the value itself
};

bool is_near_edge(const nlohmann::json& point, const Channels& size) {
    const Channels at = numbers(point.at("p"));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double share = at[axis] / size[axis];
        const bool on_wall = point.at("wall").get<std::string>()[0] == "xyz"[axis];
        if (!on_wall && std::min(share, 1 - share) < 0.09) return true;
    }
    return false;
}

Off compared(const nlohmann::json& box, const Table& table) {
    const Channels size = numbers(box.at("dims"));
    const nlohmann::json& points = box.at("points");
    Off off;
    for (std::size_t c = 0; c < 3; ++c) {
        double squares = 0, reference = 0;
        for (const nlohmann::json& point : points)
            reference += std::pow(numbers(point.at("E_indirect"))[c], 2);
        if (reference == 0) continue;
        const double rms = std::sqrt(reference / static_cast<double>(points.size()));
        for (std::size_t k = 0; k < points.size(); ++k) {
            const double difference =
                table[k].at(indirect[c]) - numbers(points[k].at("E_indirect"))[c];
            squares += difference * difference;
            double& worst = is_near_edge(points[k], size) ? off.edge : off.inner;
            worst = std::max(worst, std::abs(difference) / rms);
            const double lit = numbers(points[k].at("E_direct"))[c];
            if (lit > 0)
                off.direct = std::max(off.direct, std::abs(table[k].at(direct[c]) / lit - 1));
        }
        off.rms = std::max(off.rms, std::sqrt(squares / reference));
        std::size_t next = points.size();
        for (const Wall& wall : walls) {
            double mean = 0;
            for (const double along : weight)
                for (const double across : weight)
                    mean += along * across * table[next++].at(indirect[c]);
            const double wanted = numbers(box.at("walls").at(wall.name).at("E_indirect_mean"))[c];
            off.mean = std::max(off.mean, std::abs(mean - wanted) / rms);
        }
    }
    return off;
}

// The final gather averages what it sees: it must be ten times better than what was asked of the
// operator, and nowhere worse than that.
TEST(Boxes, MeasureReadsTheContinuousSolution) {
    LIGHTWELL_SHARED_JSON(boxes, "reference/box_continuous.json");
    for (const nlohmann::json& box : boxes) {
        SCOPED_TRACE(box.at("name").get<std::string>());
        const ScratchFolder folder;
        const std::string file = precomputed(folder, box_scene(folder, box), "0.05");
        const ProgramRun run =
            lightwell({"measure", file, "--sensors", folder.write("s.csv", sensors(box))});
        ASSERT_EQ(run.status, 0) << run.err;
        const Off off = compared(box, table_from(run.out));
        EXPECT_LT(off.direct, 1e-7);
        EXPECT_LT(off.rms, 0.005);
        EXPECT_LT(off.inner, 0.02);
        EXPECT_LT(off.edge, 0.03);
        EXPECT_LT(off.mean, 0.005);
    }
}

}  // namespace
}  // namespace lightwell
