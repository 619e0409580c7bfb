#include <cmath>

#include <gtest/gtest.h>

#include "solver/reference/path_tracer.h"
#include "tests/shared_reference.h"
#include "tests/unit/reference/rooms.h"
#include "tests/unit/reference/z_test.h"

namespace lightwell {
namespace {

const std::array<const char*, 6> wall_names{"x0", "x1", "y0", "y1", "z0_floor", "z1_ceiling"};

Vec3 vec3(const nlohmann::json& values) {
    return {values.at(0).get<double>(), values.at(1).get<double>(), values.at(2).get<double>()};
}

Rgb rgb(const nlohmann::json& values) {
    return vec3(values).array();
}

/// An empty box, its lamps, and what is known about points of it.
struct KnownBox {
    Scene scene;
    std::vector<Light> lights;
    std::vector<SurfacePoint> points;
    std::vector<Rgb> indirect, total;
};

/// Takes every `stride`-th point of those whose exact values are good to 1e-4: at least 5 % of a
/// side away from every edge.
KnownBox known_box(const nlohmann::json& room, std::size_t stride) {
    const Vec3 size = vec3(room.at("dims"));
    std::array<Rgb, 6> reflectance;
    for (std::size_t w = 0; w < 6; ++w)
        reflectance[w] = rgb(room.at("walls").at(wall_names[w]).at("rho"));
    KnownBox box;
    box.scene = box_scene(size, reflectance);
    for (const nlohmann::json& light : room.at("lights"))
        box.lights.push_back(lamp_at(vec3(light.at("pos")), rgb(light.at("I"))));
    std::size_t seen = 0;
    for (const nlohmann::json& point : room.at("points")) {
        const std::string wall_name = point.at("wall");
        int wall = 0;
        while (wall_name != wall_names[static_cast<std::size_t>(wall)])
            ++wall;
        const Vec3 position = vec3(point.at("p"));
        int near_edges = 0;
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(position[axis] / size[axis] - 0.5) > 0.45) ++near_edges;
        if (near_edges > 1 || seen++ % stride != 0) continue;
        const auto w = static_cast<std::size_t>(wall);
        box.points.push_back({position, box.scene.quads[w].quad.normal(), wall});
        box.indirect.push_back(rgb(point.at("E_indirect")));
        box.total.push_back(box.indirect.back() + rgb(point.at("E_direct")));
    }
    return box;
}

TEST(BoxContinuous, PointsOfEveryRoomAgree) {
    LIGHTWELL_SHARED_JSON(rooms, "reference/box_continuous.json");
    PathTracing how;
    how.samples = 8192;
    for (const nlohmann::json& room : rooms) {
        const KnownBox box = known_box(room, 20);
        SCOPED_TRACE(room.at("name").get<std::string>());
        ASSERT_GT(box.points.size(), 6U);
        const Visibility visibility = visibility_of(box.scene);
        const PathTracer tracer(box.scene, visibility, box.lights);
        const ZTest indirect = z_test(tracer.indirect(box.points, how).at, box.indirect);
        EXPECT_TRUE(indirect.passes())
            << indirect.outside << " of " << indirect.tested << ", worst " << indirect.worst;
        EXPECT_LT(indirect.largest_noise, 0.06);
        PathTracing shorter = how;
        shorter.samples = 1024;
        const ZTest total = z_test(tracer.total(box.points, shorter).at, box.total);
        EXPECT_TRUE(total.passes())
            << total.outside << " of " << total.tested << ", worst " << total.worst;
    }
}

// The same comparison must refuse values that are wrong.
TEST(BoxContinuous, ValuesScaledByThreePercentAreRejected) {
    LIGHTWELL_SHARED_JSON(rooms, "reference/box_continuous.json");
    KnownBox box = known_box(rooms.at("cornell_empty"), 10);
    for (Rgb& value : box.indirect)
        value *= 1.03;
    PathTracing how;
    how.samples = 4096;
    const Visibility visibility = visibility_of(box.scene);
    const PathTracer tracer(box.scene, visibility, box.lights);
    EXPECT_FALSE(z_test(tracer.indirect(box.points, how).at, box.indirect).passes());
}

}  // namespace
}  // namespace lightwell
