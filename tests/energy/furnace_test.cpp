// Closed rooms that glow alike everywhere: illuminance is M / (1 - rho), whatever their shape.
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "solver/reading/scene_reader.h"
#include "tests/energy/solved_scene.h"
#include "tests/unit/reference/rooms.h"

namespace lightwell {
namespace {

using testing::SolvedScene;

/// Largest and root mean square relative distance of the cells' irradiance from 1 lx.
struct Ripple {
    double largest = 0, rms = 0;
};

Ripple ripple_of(const SolvedScene& solved) {
    Ripple ripple;
    double area = 0, squares = 0;
    for (std::size_t e = 0; e < solved.transport.space.elements().size(); ++e) {
        const Element& element = solved.transport.space.element(e);
        const RadianceField cells = solved.total(e);
        for (std::uint32_t m = 0; m < element.functions(); ++m) {
            if (!element.open.empty() && element.open[m] == 0) continue;
            const double off = std::abs(cells(m, 0) - 1);
            const double a = element.space.area({element.space.tree().levels(), m});
            ripple.largest = std::max(ripple.largest, off);
            squares += a * off * off;
            area += a;
        }
    }
    ripple.rms = std::sqrt(squares / area);
    return ripple;
}

/// Every surface reflects rho and emits 1 - rho.
void make_furnace(Scene& scene, double rho) {
    for (Material& material : scene.materials) {
        material.reflectance.setConstant(rho);
        material.emission.setConstant((1 - rho) / M_PI);
        material.reflecting = material.emitting = Sides::front;
    }
}

void move_all(Scene& scene, const Eigen::Affine3d& by) {
    for (SceneQuad& q : scene.quads)
        for (Vec3& v : q.quad.vertex)
            v = by * v;
}

Scene box() {
    std::array<Rgb, 6> any;
    any.fill(Rgb::Constant(0.5));
    return box_scene({5, 4, 3}, any);
}

class FurnaceBox : public ::testing::TestWithParam<double> {};

TEST_P(FurnaceBox, IsUniformWhateverScaleAndFrame) {
    double worst = 0;
    for (const double scale : {1e-3, 1.0, 1e3}) {
        for (const bool turned : {false, true}) {
            Scene scene = box();
            make_furnace(scene, GetParam());
            Eigen::Affine3d by(Eigen::Scaling(scale));
            if (turned)
                by = by * Eigen::Translation3d(2, -1, 3) *
                     Eigen::AngleAxisd(0.65, Vec3(1, 2, 3).normalized());
            move_all(scene, by);
            const SolvedScene solved = testing::solved_scene(scene, {}, 0.05);
            const Ripple ripple = ripple_of(solved);
            SCOPED_TRACE(::testing::Message()
                         << "scale " << scale << " turned " << turned << " rms " << ripple.rms
                         << " mean - 1 " << solved.mean_total()[0] - 1);
            worst = std::max({worst, ripple.rms, std::abs(solved.mean_total()[0] - 1)});
            EXPECT_NEAR(solved.mean_total()[0], 1, 1e-5);
            EXPECT_LT(ripple.rms, 1e-5);
            EXPECT_LT(ripple.largest, 1e-4);
        }
    }
    RecordProperty("reached", std::to_string(worst));
}

INSTANTIATE_TEST_SUITE_P(Reflectances, FurnaceBox, ::testing::Values(0.3, 0.8, 0.95));

class FurnaceWithBlocks : public ::testing::TestWithParam<double> {};

TEST_P(FurnaceWithBlocks, IsUniform) {
    Scene scene = read_scene(std::string(LIGHTWELL_SCENES) + "/furnace/scene.toml").scene;
    make_furnace(scene, GetParam());
    const SolvedScene solved = testing::solved_scene(scene, {}, 0.05);
    const Ripple ripple = ripple_of(solved);
    SCOPED_TRACE(::testing::Message() << "rms " << ripple.rms << " largest " << ripple.largest
                                      << " mean - 1 " << solved.mean_total()[0] - 1);
    EXPECT_NEAR(solved.mean_total()[0], 1, 1e-3);
    EXPECT_LT(ripple.rms, 1e-3);
    RecordProperty("reached_mean", std::to_string(solved.mean_total()[0] - 1));
    RecordProperty("reached_rms", std::to_string(ripple.rms));
}

INSTANTIATE_TEST_SUITE_P(Reflectances, FurnaceWithBlocks, ::testing::Values(0.5, 0.9));

}  // namespace
}  // namespace lightwell
