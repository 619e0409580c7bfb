#include "viewer/stability/energy_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "viewer/stability/case_scenes.h"
#include "viewer/stability/lit_scene.h"

namespace lightwell::stability {

std::vector<Finding> bright_room() {
    Scene scene = room({3, 3, 3}, 0);
    const Rgb albedo(0.95, 0.98, 0.99);
    for (Material& material : scene.materials)
        material.reflectance = albedo;
    const LitScene lit(scene, 0.05);
    const std::vector<Light> lights = {lamp({1.2, 1.7, 1.4})};
    const auto residual = [&](Propagation how) {
        const Lighting lighting = lit.light(lights, how);
        const Rgb total = total_flux(lit.transport().space, lighting.direct + lighting.indirect);
        return Rgb(total * (1 - albedo) / (4000 * M_PI) - 1);
    };
    const Rgb solved = residual(Propagation::solved), stored = residual(Propagation::stored);
    const RadianceSpace& space = lit.transport().space;
    RadianceField uniform = RadianceField::Zero(space.functions(), 3);
    for (const Element& wall : space.elements())
        uniform.row(wall.first).setConstant(std::sqrt(wall.area()));
    const RadianceField received = propagated(lit.transport().bounce, uniform);
    double wall_sums = 0;
    for (const Element& wall : space.elements())
        wall_sums =
            std::max(wall_sums, std::abs(received(wall.first, 0) / uniform(wall.first, 0) - 1));
    return {{"energy, solved", solved.abs().maxCoeff(), 1e-4},
            {"energy more than there is, solved", solved.maxCoeff(), 1e-4},
            {"energy, stored", stored.abs().maxCoeff(), 1e-4, 0.011},
            {"sums of form factors of walls", wall_sums, 1e-5},
            {"sums of form factors of cells, rms", lit.report().closure.deficit_after, 1e-5, 3e-3}};
}

namespace {

/// A room with three blocks in which no two surfaces reflect alike, from 0.1 to 0.9.
Scene motley_furnace() {
    Scene scene = room({5, 4, 3}, 0.5);
    add_block(scene, {0.5, 0.5, 0}, {1.5, 1.3, 1}, 0.5);
    add_block(scene, {3, 1, 0}, {4, 2, 2}, 0.5);
    add_block(scene, {1.2, 2.6, 0}, {3.1, 3.4, 0.75}, 0.5);
    for (std::size_t m = 0; m < scene.materials.size(); ++m)
        scene.materials[m].reflectance.setConstant(0.1 + 0.1 * static_cast<double>(7 * m % 9));
    make_furnace(scene);
    return scene;
}

}  // namespace

std::vector<Finding> truncated_energy() {
    const LitScene coarse(motley_furnace(), 0.1), fine(motley_furnace(), 0.05);
    const double stored_coarse = ripple_of(coarse, Propagation::stored).mean;
    const double stored_fine = ripple_of(fine, Propagation::stored).mean;
    return {{"mean of a furnace with blocks, solved", ripple_of(fine).mean, 1e-3},
            {"the same, stored", stored_fine, 1e-3},
            {"the same, --error 0.05 over 0.1", stored_fine / std::max(stored_coarse, 1e-3), 1}};
}

std::vector<Finding> truncated_series() {
    double worst = 0, converged = 0;
    for (const double rho : {0.9, 0.95, 0.99}) {
        Scene scene = room({5, 4, 3}, rho);
        make_furnace(scene);
        const LitScene lit(scene, 0.1);
        const GlobalTransport& transport = lit.transport();
        const RadianceField direct = lit.light({}).direct;
        RadianceField sum = direct, power = direct;
        const RadianceField reflectance = reflectance_of(transport.scene, transport.space);
        for (int k = 1; k <= 20; ++k) {
            power = propagated(transport.bounce, reflectance * power);
            sum += power;
            const double left = 1 - lit.mean(sum), wanted = std::pow(rho, k + 1);
            worst = std::max(worst, std::abs(left / wanted - 1));
        }
        converged = std::max(converged, ripple_of(lit).mean);
    }
    return {{"light that 20 bounces leave, of rho^21", worst, 0.01},
            {"light that all bounces leave", converged, 1e-4}};
}

namespace {

/// A furnace in which two quads cross each other, and two lie side by side on the floor.
Scene crossed() {
    Scene scene = room({4, 3, 2.5}, 0.5);
    add_quad(scene, rectangle({1, 1, 0.5}, {1.5, 0, 0}, {0, 0.8, 0.8}), 0.5);
    add_quad(scene, rectangle({1, 1, 1.3}, {1.5, 0, 0}, {0, 0.8, -0.8}), 0.5);
    add_quad(scene, rectangle({2.5, 1.5, 0.6}, {0.7, 0, 0}, {0, 0.9, 0}), 0.5);
    add_quad(scene, rectangle({3.2, 1.5, 0.6}, {0.5, 0, 0}, {0, 0.9, 0}), 0.5);
    make_furnace(scene);
    for (std::size_t m = 6; m < scene.materials.size(); ++m)
        scene.materials[m].reflecting = scene.materials[m].emitting = Sides::both;
    return scene;
}

}  // namespace

std::vector<Finding> crossing_quads() {
    double ripple = 0, mean = 0, scale_matters = 0;
    Eigen::ArrayXd at_one;
    for (const double scale : {1.0, 1e-3, 1e3}) {
        const LitScene lit(moved(crossed(), Eigen::Affine3d(Eigen::Scaling(scale))), 0.1);
        const Ripple found = ripple_of(lit);
        ripple = std::max(ripple, found.rms);
        mean = std::max(mean, found.mean);
        const Lighting lighting = lit.light({});
        const Eigen::ArrayXd lux = lit.cells(lighting.direct + lighting.indirect);
        if (scale == 1)
            at_one = lux;
        else
            scale_matters = std::max(scale_matters, lux.size() == at_one.size()
                                                        ? (lux - at_one).abs().maxCoeff()
                                                        : std::numeric_limits<double>::infinity());
    }
    return {{"mean illuminance of the furnace", mean, 1e-3},
            {"ripple of the furnace, rms", ripple, 1e-3},
            {"results at scales 0.001 and 1000 against 1", scale_matters, 1e-4}};
}

std::vector<Finding> needle_quads() {
    Scene scene = room({4, 3, 2.5}, 0.5);
    // A wire of 3 m and 0.3 mm across the room, and a band of that width along the floor's rim.
    add_quad(scene, rectangle({0.5, 1.5, 1}, {3, 0, 0}, {0, 3e-4, 0}), 0.5);
    make_furnace(scene);
    const Quad floor = scene.quads[4].quad;
    scene.quads[4].quad = floor.part(0, 1, 1e-4, 1);
    add_quad(scene, floor.part(0, 1, 0, 1e-4), 0.5);
    make_furnace(scene);
    scene.materials[6].reflecting = scene.materials[6].emitting = Sides::both;
    const Ripple found = ripple_of(LitScene(scene, 0.1));
    return {{"mean illuminance of a furnace with needles", found.mean, 1e-3},
            {"ripple of the furnace, rms", found.rms, 1e-3}};
}

std::vector<Finding> black_and_white() {
    Scene black = room({4, 3, 2.5}, 0);
    const LitScene dark(black, 0.1);
    const double lit_black =
        dark.light({lamp({1, 1, 1})}, Propagation::solved).indirect.abs().maxCoeff();
    // White walls around a black floor: everything ends up there.
    const LitScene white(room({4, 3, 2.5}, {1, 1, 1, 1, 0, 1}), 0.1);
    const Lighting lighting = white.light({lamp({1, 1, 1}, 1 / (4 * M_PI))});
    const RadianceField all = lighting.direct + lighting.indirect;
    const Element& floor = white.transport().space.element(4);
    const double on_floor = M_PI * std::sqrt(floor.area()) * all(floor.first, 0);
    return {{"indirect light between black walls", lit_black, 1e-12},
            {"flux of a lamp between white walls that the black floor misses",
             std::abs(on_floor - 1), 1e-3}};
}

}  // namespace lightwell::stability
