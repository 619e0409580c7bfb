#include "viewer/stability/direct_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "radiance4d/basis/direction_map.h"
#include "radiance4d/scene/scene_quads.h"
#include "viewer/stability/case_scenes.h"
#include "viewer/stability/closed_forms.h"
#include "viewer/stability/emitting_scene.h"
#include "viewer/stability/projected_scene.h"

namespace lightwell::stability {

// A light a millimetre to a metre above the floor.
std::vector<Finding> grazing_receiver() {
    double worst_measured = 0, worst_drawn = 0, lowest = 0;
    for (const double h : {1.0, 0.3, 0.1, 0.03, 0.01, 0.003, 0.001}) {
        const ProjectedScene floor({level({0, 4, 0, 4}, 0)}, 0.26);
        const CellTree& tree = floor.space().element(0).space.tree();
        const double side = 4.0 / tree.columns();
        const std::vector<Light> lights = {lamp({1.7, 2.2, h}, 1)};
        const Eigen::ArrayXd measured = floor.cells(0, floor.measured(lights));
        const Eigen::ArrayXd drawn = floor.cells(0, floor.drawn(lights));
        for (std::uint32_t j = 0; j < tree.rows(); ++j)
            for (std::uint32_t i = 0; i < tree.columns(); ++i) {
                const double wanted =
                    flux_of_one_candela(h, {i * side - 1.7, (i + 1) * side - 1.7, j * side - 2.2,
                                            (j + 1) * side - 2.2}) /
                    (side * side);
                const std::uint32_t cell = tree.finest_at(i, j);
                worst_measured = std::max(worst_measured, std::abs(measured[cell] / wanted - 1));
                worst_drawn = std::max(worst_drawn, std::abs(drawn[cell] / wanted - 1));
                lowest = std::min({lowest, measured[cell], drawn[cell]});
            }
    }
    const ProjectedScene floor({level({0, 4, 0, 4}, 0)}, 0.26);
    const double in_plane = floor.flux(floor.measured({lamp({5, 5, 0}, 1)})) +
                            floor.flux(floor.drawn({lamp({5, 5, 0}, 1)}));
    return {{"means of cells, measured", worst_measured, 0.01},
            {"means of cells, drawn", worst_drawn, 0.01},
            {"light below nothing [lx]", -lowest, 0},
            {"flux of a lamp in the floor's plane [lm]", std::abs(in_plane), 1e-9}};
}

// A hemisphere mapped to a square through its top face loses what is near the horizon; ours loses
// nothing.
std::vector<Finding> direction_map_rim() {
    constexpr int n = 1 << 20;
    const double low = std::cos(89 * M_PI / 180), high = std::cos(85 * M_PI / 180);
    int strip = 0;
    double furthest = 0;
    Vec2 st(0.5, 0.5);
    for (int k = 0; k < n; ++k) {
        // The additive sequence on the generalised golden ratio (Roberts 2018).
        st += Vec2(0.75487766624669276, 0.56984029099805327);
        st = (st.array() - st.array().floor()).matrix();
        const Vec3 direction = direction_from_square(st);
        if (direction[2] > low && direction[2] < high) ++strip;
        furthest = std::max(furthest, (square_from_direction(direction) - st).norm());
    }
    const double wanted = high * high - low * low;
    return {{"energy at 85 to 89 degrees from the normal",
             std::abs(strip / static_cast<double>(n) / wanted - 1), 0.01},
            {"energy of all directions that has no place", furthest, 1e-4}};
}

std::vector<Finding> spot_cone_edge() {
    const double h = 0.5;
    const ProjectedScene floor({level({-4, 4, -4, 4}, 0)}, 0.0626);
    const CellTree& tree = floor.space().element(0).space.tree();
    const double side = 8.0 / tree.columns();
    double worst_measured = 0, worst_drawn = 0, stray = 0;
    for (const double angle : {15.0, 30.0, 45.0, 60.0, 75.0}) {
        const double radian = angle * M_PI / 180;
        const SpotLight spot{"spot", {0.013, 0.021, h}, Rgb::Ones(), -Vec3::UnitZ(), angle, angle};
        const double wanted = 2 * M_PI * (1 - std::cos(radian));
        const RadianceField measured = floor.measured({spot}), drawn = floor.drawn({spot});
        worst_measured = std::max(worst_measured, std::abs(floor.flux(measured) / wanted - 1));
        worst_drawn = std::max(worst_drawn, std::abs(floor.flux(drawn) / wanted - 1));
        const Eigen::ArrayXd cells = floor.cells(0, drawn);
        const double radius = h * std::tan(radian);
        for (std::uint32_t j = 0; j < tree.rows(); ++j)
            for (std::uint32_t i = 0; i < tree.columns(); ++i) {
                const double r = std::hypot((i + 0.5) * side - 4.013, (j + 0.5) * side - 4.021);
                const double full = h / std::pow(r * r + h * h, 1.5);
                const double lit = cells[tree.finest_at(i, j)] / full;
                // A leaf's diagonal outside of the cone it is dark, inside it has all its light.
                if (r > radius + 1.5 * side) stray = std::max(stray, std::abs(lit));
                if (r < radius - 1.5 * side) stray = std::max(stray, std::abs(lit - 1));
            }
    }
    return {{"flux on the floor, measured", worst_measured, 5e-3},
            {"flux on the floor, drawn", worst_drawn, 5e-3},
            {"light a leaf outside of the cone, or missing inside", stray, 0.01}};
}

// A wall's point a quarter of a metre from an opening of 4 x 4 m: CIE 171, case 5.6, point A.
std::vector<Finding> opening_edge() {
    EmittingScene scene({rectangle({0, 0, 0}, {4, 0, 0}, {0, 0, 3}).reversed()});
    scene.add(level({0, 4, 0, 4}, 0), 1 / M_PI);
    const double found = scene.irradiance({2, 0, 0.25}, Vec3::UnitY(), 0);
    return {{"irradiance near the opening", std::abs(found / 0.4512260356378262 - 1), 5e-3}};
}

std::vector<Finding> lamp_on_a_surface() {
    const ProjectedScene projected(quads_of(room({4, 4, 3}, 0.5)), 0.26);
    // In the plane itself: on which side it is, is for rounding to say; but what comes, is light.
    double worst = 0;
    for (const Vec3& place :
         {Vec3(1.3, 1.7, 3), Vec3(2, 2, 3), Vec3(0, 1, 1), Vec3(0, 0, 1), Vec3(0, 0, 0)}) {
        const std::vector<Light> lights = {lamp(place, 1 / (4 * M_PI))};
        // Nothing falls on the planes that hold it: half of the flux, a quarter, an eighth is left.
        int planes = 0;
        for (int axis = 0; axis < 3; ++axis)
            planes += place[axis] == 0 || place[axis] == (axis == 2 ? 3 : 4) ? 1 : 0;
        const double wanted = std::pow(0.5, planes);
        for (const double found :
             {projected.flux(projected.measured(lights)), projected.flux(projected.drawn(lights))})
            worst = std::isfinite(found) ? std::max(worst, std::abs(found / wanted - 1))
                                         : std::numeric_limits<double>::infinity();
    }
    // A hundredth of a millimetre below the ceiling.
    const std::vector<Light> below = {lamp({1.3, 1.7, 3 - 1e-5}, 1 / (4 * M_PI))};
    const double lost = std::max(std::abs(projected.flux(projected.measured(below)) - 1),
                                 std::abs(projected.flux(projected.drawn(below)) - 1));
    return {{"flux of a lamp in walls, edges and corners", worst, 1e-3},
            {"flux that a lamp 0.01 mm from the ceiling loses", lost, 1e-3}};
}

std::vector<Finding> lamp_outside() {
    const ProjectedScene projected(quads_of(room({4, 4, 3}, 0.5)), 0.26);
    double worst = 0;
    for (const Vec3& place : {Vec3(-1, 2, 1), Vec3(2, 2, 3.01), Vec3(5, 5, 5)}) {
        const std::vector<Light> lights = {lamp(place)};
        worst = std::max({worst, projected.measured(lights).abs().maxCoeff(),
                          projected.drawn(lights).abs().maxCoeff()});
    }
    return {{"light inside of a closed room", worst, 0}};
}

}  // namespace lightwell::stability
