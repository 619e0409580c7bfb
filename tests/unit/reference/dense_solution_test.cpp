#include "solver/reference/dense_solution.h"

#include <cmath>

#include <gtest/gtest.h>

#include "radiance4d/gauss_rule.h"
#include "solver/reference/path_tracer.h"
#include "solver/reference/polygon_factor.h"
#include "tests/shared_reference.h"
#include "tests/unit/reference/rooms.h"

namespace lightwell {
namespace {

std::vector<QuadSide> all_fronts(const Scene& scene) {
    std::vector<QuadSide> sides;
    for (int q = 0; q < static_cast<int>(scene.quads.size()); ++q)
        sides.push_back({q, true});
    return sides;
}

TEST(GaussRule, IntegratesPolynomialsExactly) {
    for (const int count : {1, 2, 3, 4, 8}) {
        const GaussRule rule(count);
        for (int degree = 0; degree < 2 * count; ++degree) {
            double sum = 0;
            for (std::size_t k = 0; k < rule.nodes.size(); ++k)
                sum += rule.weights[k] * std::pow(rule.nodes[k], degree);
            EXPECT_NEAR(sum, 1.0 / (degree + 1), 1e-14) << count << " nodes, degree " << degree;
        }
    }
}

TEST(PointToQuadFactor, IsTheClosedFormForARectangleAboveItsCorner) {
    const double a = 2, b = 3, c = 1.5;
    const Quad rectangle{{Vec3(0, 0, c), Vec3(a, 0, c), Vec3(a, b, c), Vec3(0, b, c)}};
    const double x = a / c, y = b / c;
    const double along_x = std::sqrt(1 + x * x), along_y = std::sqrt(1 + y * y);
    const double exact =
        (x / along_x * std::atan(y / along_x) + y / along_y * std::atan(x / along_y)) / (2 * M_PI);
    EXPECT_NEAR(point_to_quad_factor(Vec3::Zero(), Vec3::UnitZ(), rectangle), exact, 1e-15);
    EXPECT_EQ(point_to_quad_factor(Vec3::Zero(), -Vec3::UnitZ(), rectangle), 0);
}

// A wall that sinks through the horizon counts with its upper part only.
TEST(PointToQuadFactor, IsClippedAtTheHorizon) {
    const Quad upper{{Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(1, 1, 2), Vec3(1, -1, 2)}};
    const Quad whole{{Vec3(1, -1, -5), Vec3(1, 1, -5), Vec3(1, 1, 2), Vec3(1, -1, 2)}};
    EXPECT_NEAR(point_to_quad_factor(Vec3::Zero(), Vec3::UnitZ(), whole),
                point_to_quad_factor(Vec3::Zero(), Vec3::UnitZ(), upper), 1e-15);
}

TEST(DenseSolution, IsTheExactGalerkinSolutionOfEmptyBoxes) {
    LIGHTWELL_SHARED_JSON(rooms, "reference/box_galerkin.json");
    for (const auto& [name, room] : rooms.items()) {
        SCOPED_TRACE(name);
        const auto rgb_at = [](const nlohmann::json& list, std::size_t k) {
            return Rgb(list.at(k).at(0).get<double>(), list.at(k).at(1).get<double>(),
                       list.at(k).at(2).get<double>());
        };
        const auto size = room.at("dims").get<std::vector<double>>();
        std::array<Rgb, 6> rho;
        for (std::size_t w = 0; w < 6; ++w)
            rho[w] = rgb_at(room.at("rho"), w);
        const Scene scene = box_scene({size[0], size[1], size[2]}, rho);
        std::vector<Light> lights;
        for (const auto& light : room.at("lights"))
            lights.push_back(lamp_at(rgb_at(light, 0).matrix(), rgb_at(light, 1)));
        const Visibility visibility = visibility_of(scene);
        for (const int level : {0, 1, 2}) {
            SCOPED_TRACE(level);
            const auto& exact = room.at("levels").at(std::to_string(level));
            const int cells = 1 << level;
            const DenseSolution dense(scene, visibility, all_fronts(scene), {cells, 24 / cells, 0});
            const std::vector<Rgb> direct = dense.from_lamps(lights);
            const std::vector<Rgb> indirect = dense.indirect(direct);
            for (std::size_t k = 0; k < dense.cells().size(); ++k) {
                const DenseCell& cell = dense.cells()[k];
                const auto wall = static_cast<std::size_t>(cell.side.quad);
                // The file runs over the wall's first tangential axis, then its second.
                std::size_t patch = wall;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    if (axis != wall / 2)
                        patch = patch * static_cast<std::size_t>(cells) +
                                static_cast<std::size_t>(
                                    cell.shape.centre()[static_cast<Eigen::Index>(axis)] /
                                    size[axis] * cells);
                const Rgb radiosity = rho[wall] * (direct[k] + indirect[k]);
                const Rgb known = rgb_at(exact.at("B_patch"), patch);
                EXPECT_LT((radiosity / known - 1).abs().maxCoeff(), 1e-3) << "patch " << patch;
            }
        }
    }
}

// Two independent ways, one answer: a room with a block, whose shadows both must see.
TEST(DenseSolution, AgreesWithThePathTracerWhereThereAreShadows) {
    std::array<Rgb, 6> rho;
    rho.fill(Rgb(0.7, 0.5, 0.3));
    Scene scene = box_scene({3, 3, 3}, rho);
    add_block(scene, {0.8, 0.9, 0.6}, {2.0, 2.1, 1.4}, Rgb::Constant(0.5));
    scene.materials[x0].emission = Rgb(1, 2, 4);
    const Visibility visibility = visibility_of(scene);
    const std::vector<Light> lights{lamp_at({2.2, 1.2, 2.3}, Rgb::Constant(20))};

    const DenseSolution dense(scene, visibility, all_fronts(scene), {5, 3, 2});
    std::vector<Rgb> direct = dense.from_lamps(lights);
    const std::vector<Rgb> from_emitters = dense.from_emitters();
    for (std::size_t k = 0; k < direct.size(); ++k)
        direct[k] += from_emitters[k];
    const std::vector<Rgb> indirect = dense.indirect(direct);
    Rgb dense_mean = Rgb::Zero();
    double area = 0;
    for (std::size_t k = 0; k < indirect.size(); ++k) {
        dense_mean += indirect[k] * dense.cells()[k].area;
        area += dense.cells()[k].area;
    }
    dense_mean /= area;

    PathTracing how;
    how.samples = 128;
    const LightSurvey traced =
        PathTracer(scene, visibility, lights)
            .indirect(sample_surface(scene, all_fronts(scene), 2000, 1), how);
    Rgb traced_mean = Rgb::Zero();
    for (const LightEstimate& one : traced.at)
        traced_mean += one.mean / 2000;
    EXPECT_LT((dense_mean / traced_mean - 1).abs().maxCoeff(), 0.01)
        << dense_mean.transpose() << " and " << traced_mean.transpose();
}

}  // namespace
}  // namespace lightwell
