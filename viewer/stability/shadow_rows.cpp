#include "viewer/stability/shadow_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "radiance4d/scene/scene_quads.h"
#include "solver/transport/shaft.h"
#include "viewer/stability/case_scenes.h"
#include "viewer/stability/closed_forms.h"
#include "viewer/stability/emitting_scene.h"
#include "viewer/stability/projected_scene.h"

namespace lightwell::stability {

// A table leg of 5 x 5 cm under a lamp: what it hides is known in closed form.
std::vector<Finding> small_occluder() {
    const double blocked = 3.32565;  // [lm]: front 2.97582 and top 0.34983
    Scene scene;
    add_quad(scene, level({0, 4, 0, 4}, 0), 0.5);
    const ProjectedScene empty(quads_of(scene), 0.25);
    add_block(scene, {1.975, 1.975, 0}, {2.025, 2.025, 0.7}, 0.5);
    const ProjectedScene furnished(quads_of(scene), 0.25);
    const std::vector<Light> lights = {lamp({0.5, 2, 2.5})};
    const double all = empty.flux(0, empty.measured(lights));
    const auto off = [&](const RadianceField& field) {
        return std::abs((all - furnished.flux(0, field)) / blocked - 1);
    };
    // And light from the ceiling that passes by it.
    const Quad floor = level({0, 4, 0, 4}, 0), ceiling = level({0, 4, 0, 4}, 3).reversed();
    const Shaft shaft(Facet::of(floor, floor.normal()), Facet::of(ceiling, ceiling.normal()));
    const std::vector<Quad> quads = quads_of(scene);
    const bool missed = std::none_of(quads.begin() + 1, quads.end(),
                                     [&](const Quad& q) { return shaft.may_be_cut_by(q); });
    return {{"flux hidden from the floor, measured", off(furnished.measured(lights)), 0.2},
            {"flux hidden from the floor, drawn", off(furnished.drawn(lights)), 0.2},
            {"links that call the leg's surroundings clear", missed ? 1.0 : 0.0, 0}};
}

// A point light behind a rectangle: no piecewise constant function can be better than the means
// over its cells.
std::vector<Finding> shadow_edge() {
    const Rectangle floor{0, 4, 0, 4}, shadow{1.4, 2.9, 0.775, 1.9};
    const Vec3 light(1.7, 2.2, 3);
    const double candela = 1000;
    const std::vector<Quad> quads = {level(floor, 0), level({1.5, 2.5, 1.25, 2}, 1)};
    const std::array<double, 6> best = {.38675478534589713, .32772690218423345, .2603220613531079,
                                        .20533326844548405, .1590758150379738,  .10014427869559817};
    const auto mean_over = [&](const Rectangle& cell) {
        const auto flux = [&](const Rectangle& r) {
            return candela * flux_of_one_candela(light[2], {r.x0 - light[0], r.x1 - light[0],
                                                            r.y0 - light[1], r.y1 - light[1]});
        };
        return (flux(cell) - flux(common(cell, shadow))) /
               ((cell.x1 - cell.x0) * (cell.y1 - cell.y0));
    };
    // The squared norm of the irradiance itself follows from the best error of any level.
    double squared_norm = 0;
    std::array<double, 2> worst_ratio{}, worst_mean{};
    for (int l = 5; l >= 0; --l) {
        const int n = 1 << l;
        const double side = 4.0 / n;
        const ProjectedScene projected(quads, 1.001 * side);
        const CellTree& tree = projected.space().element(0).space.tree();
        const std::array<RadianceField, 2> fields = {projected.measured({lamp(light, candela)}),
                                                     projected.drawn({lamp(light, candela)})};
        const std::array<Eigen::ArrayXd, 2> cells = {projected.cells(0, fields[0]),
                                                     projected.cells(0, fields[1])};
        std::array<double, 2> squares{};
        double of_means = 0;
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const Rectangle cell{i * side, (i + 1) * side, j * side, (j + 1) * side};
                const double wanted = mean_over(cell);
                const Rectangle dark = common(cell, shadow);
                const double dark_area = (dark.x1 - dark.x0) * (dark.y1 - dark.y0);
                of_means += side * side * wanted * wanted;
                for (std::size_t way = 0; way < 2; ++way) {
                    const double off = cells[way][tree.finest_at(static_cast<std::uint32_t>(i),
                                                                 static_cast<std::uint32_t>(j))] -
                                       wanted;
                    squares[way] += side * side * off * off;
                    if (dark_area == 0 || wanted < 1e-9)
                        worst_mean[way] = std::max(
                            worst_mean[way], std::abs(off) / std::max(wanted, 0.01 * candela));
                }
            }
        }
        const double best_here = best[static_cast<std::size_t>(l)];
        if (l == 5) squared_norm = of_means / (1 - best_here * best_here);
        for (std::size_t way = 0; way < 2; ++way)
            worst_ratio[way] = std::max(
                worst_ratio[way],
                std::sqrt(best_here * best_here + squares[way] / squared_norm) / best_here);
    }
    return {{"error over the best of any Haar function, measured", worst_ratio[0], 1.05},
            {"error over the best of any Haar function, drawn", worst_ratio[1], 1.05},
            {"means of cells all lit or all dark, measured", worst_mean[0], 1e-3},
            {"means of cells all lit or all dark, drawn", worst_mean[1], 1e-3}};
}

// A square light 3 m above the floor, half of it hidden by a square 1.5 m above it.
std::vector<Finding> penumbra() {
    EmittingScene scene({level({-5, 5, -5, 5}, 0), level({-0.3, 0.7, -0.5, 0.5}, 1.5)});
    scene.add(level({-0.5, 0.5, -0.5, 0.5}, 3).reversed(), 1000);
    double worst = 0, falls = 0, last = 0;
    for (int k = 0; k <= 120; ++k) {
        const double x = -3 + 0.05 * k;
        const Rectangle light{-0.5 - x, 0.5 - x, -0.5, 0.5};
        // The blocker as seen on the light's plane, twice as far away.
        const Rectangle hidden = common(light, {2 * (-0.3 - x), 2 * (0.7 - x), -1, 1});
        const double open = 1000 * M_PI * factor_to_parallel(3, light);
        const double wanted = open - 1000 * M_PI * factor_to_parallel(3, hidden);
        const double found = scene.irradiance({x, 0, 0}, Vec3::UnitZ(), 0);
        worst = std::max(worst, std::abs(found - wanted) / open);
        // Out of the umbra, past the blocker's far edge, it only gets brighter.
        if (x > 0.6 && x < 1.8) falls = std::max(falls, last - found);
        last = found;
    }
    return {{"irradiance, of that without the blocker", worst, 0.01},
            {"steps down where the penumbra brightens [lx]", std::max(0.0, falls), 0}};
}

// A window of 2 x 1 m behind twenty strips, 25 mm apart.
std::vector<Finding> occlusion_aliasing() {
    double worst = 0;
    std::array<double, 2> found_range{1, 0}, wanted_range{1, 0};
    for (const double phase : {0.0, 0.00625, 0.0125, 0.01875}) {
        EmittingScene scene({level({-4, 4, 0, 6}, 0)});
        const double behind = 1e-3;
        // Bigger and farther than the window by the same ratio would be hard to compare: the
        // strips are in the window's plane, the light just behind it.
        scene.add(rectangle({1, -behind, 1}, {-2, 0, 0}, {0, 0, 1}), 1 / M_PI);
        std::vector<Rectangle> closed;
        const auto close = [&](double from, double to) {
            from = std::max(from, 1.0);
            to = std::min(to, 2.0);
            if (to > from) closed.push_back({-1, 1, from, to});
        };
        for (int k = -1; k < 20; ++k)
            close(1 + 0.05 * k + 0.025 + phase, 1 + 0.05 * k + 0.05 + phase);
        for (const Rectangle& strip : closed)
            add_quad(scene.scene,
                     rectangle({4, 0, strip.y0}, {-8, 0, 0}, {0, 0, strip.y1 - strip.y0}), 0);
        for (const double y : {0.25, 0.75, 1.25}) {
            const double at = y + behind;
            double wanted = factor_to_perpendicular(at, {-1, 1, 1, 2});
            for (const Rectangle& strip : closed) {
                // What the strip hides of the light that lies `behind` it.
                const double magnified = at / y;
                const Rectangle hidden =
                    common({-1, 1, 1, 2}, {-1, 1, strip.y0 * magnified, strip.y1 * magnified});
                wanted -= factor_to_perpendicular(at, hidden);
            }
            const double found = scene.irradiance({0, y, 0}, Vec3::UnitZ(), 0);
            worst = std::max(worst, std::abs(found / wanted - 1));
            if (y == 0.75) {
                found_range = {std::min(found_range[0], found), std::max(found_range[1], found)};
                wanted_range = {std::min(wanted_range[0], wanted),
                                std::max(wanted_range[1], wanted)};
            }
        }
    }
    return {{"irradiance, all phases", worst, 0.02},
            {"spread over phases, of the true one",
             (found_range[1] - found_range[0]) / (wanted_range[1] - wanted_range[0]), 3}};
}

// Lamps in the planes of a block's faces and on the lines of its edges: every ray to the floor
// grazes something.
std::vector<Finding> rays_along_edges() {
    Scene scene = room({4, 4, 3}, 0.5);
    add_block(scene, {1, 1, 0}, {2, 2, 1}, 0.5);
    double worst_measured = 0, worst_drawn = 0;
    const ProjectedScene projected(quads_of(scene), 0.26);
    for (const Vec3& place : {Vec3(1, 3, 2), Vec3(1, 1, 2), Vec3(3, 3, 1), Vec3(2, 3, 1),
                              Vec3(3, 3, 2), Vec3(2, 2, 2.5), Vec3(3, 1, 0.5)}) {
        const std::vector<Light> lights = {lamp(place, 1 / (4 * M_PI))};
        worst_measured =
            std::max(worst_measured, std::abs(projected.flux(projected.measured(lights)) - 1));
        worst_drawn = std::max(worst_drawn, std::abs(projected.flux(projected.drawn(lights)) - 1));
    }
    return {{"flux that gets lost, measured", worst_measured, 1e-3},
            {"flux that gets lost, drawn", worst_drawn, 1e-3}};
}

}  // namespace lightwell::stability
