#include "viewer/stability/leak_rows.h"

#include <algorithm>
#include <cmath>

#include "solver/reading/wall_cutting.h"
#include "solver/reference/path_tracer.h"
#include "viewer/stability/case_scenes.h"
#include "viewer/stability/lit_scene.h"

namespace lightwell::stability {

namespace {

/// Two rooms of 4 x 4 x 3 m on one floor, under one ceiling and between the same long walls.
Scene two_rooms(double wall, double raised) {
    Scene scene = room({8, 4, 3}, 0.5);
    add_quad(scene, rectangle({wall, 0, raised}, {0, 4, 0}, {0, 0, 3 - raised}), 0.5);
    return scene;
}

struct Leak {
    double largest = 0;
    double beyond = 0;      ///< the largest, beyond the leaves at the wall
    double straddling = 0;  ///< share of the second room that these leaves may reach into
    double mean = 0;
};

/// What the second room receives of a lamp in the first, of what the first has.
Leak leak(const Scene& scene, double wall) {
    const LitScene lit(scene, 0.1);
    const double leaf = lit.transport().provenance.cell_size;
    const Lighting lighting = lit.light({lamp({1.5, 2, 1.5})});
    const Eigen::ArrayXd lux = lit.cells(lighting.direct + lighting.indirect);
    const Eigen::ArrayXd area = lit.cell_areas();
    double first = 0, first_area = 0, second = 0, second_area = 0;
    Leak result;
    for (const Element& element : lit.transport().space.elements())
        for (std::uint32_t m = 0; m < element.functions(); ++m) {
            const Quad cell = element.cell({element.space.tree().levels(), m});
            const double x = cell.centre()[0] + 1e-6 * element.geometry.normal()[0];
            const Eigen::Index k = element.first + m;
            const bool is_second = x > wall;
            (is_second ? second : first) += area[k] * lux[k];
            (is_second ? second_area : first_area) += area[k];
            if (x > wall + leaf) result.beyond = std::max(result.beyond, std::abs(lux[k]));
            if (is_second) result.largest = std::max(result.largest, std::abs(lux[k]));
        }
    const double mean = first / first_area;
    result.largest /= mean;
    result.beyond /= mean;
    result.straddling = leaf / (8 - wall);
    result.mean = second / second_area / mean;
    return result;
}

Scene cut(Scene scene) {
    scene.quads = cut_along_walls(scene.quads).quads;
    return scene;
}

}  // namespace

std::vector<Finding> light_leak() {
    const Leak in_the_middle = leak(two_rooms(4, 0), 4), across = leak(two_rooms(3.7, 0), 3.7);
    return {{"quads cut at the wall, x = 4 m", leak(cut(two_rooms(4, 0)), 4).largest, 1e-6},
            {"quads cut at the wall, x = 3.7 m", leak(cut(two_rooms(3.7, 0)), 3.7).largest, 1e-6},
            {"uncut, x = 4 m", in_the_middle.largest, 1e-3, 0.03},
            {"uncut, x = 3.7 m, beyond the leaves at the wall", across.beyond, 1e-3, 0.03},
            {"uncut, x = 3.7 m, mean", across.mean, across.straddling},
            {"wall raised by 1 mm, mean", leak(cut(two_rooms(4, 1e-3)), 4).mean, 1e-3}};
}

// A slab sunk 2 cm into a wall: no shadow may spread over the wall around it.
std::vector<Finding> shadow_leak() {
    Scene scene = office();
    add_block(scene, {2, -0.02, 1}, {3, 0.03, 2}, 0.5);
    const LitScene lit(scene, 0.05);
    const double leaf = lit.transport().provenance.cell_size;
    std::vector<SurfacePoint> points;
    for (const auto& [x, z] :
         {std::pair{2 - 2 * leaf, 1.5}, std::pair{3 + 2 * leaf, 1.5}, std::pair{2.5, 1 - 2 * leaf},
          std::pair{2.5, 2 + 2 * leaf}, std::pair{2 - leaf, 1.2}, std::pair{3 + leaf, 1.8}})
        points.push_back({{x, 0, z}, Vec3::UnitY(), 2});
    const std::vector<Light> lights = {lamp(office_lamp())};
    const Visibility visibility(lit.quads());
    NoiseTarget target;
    target.relative = 2e-3;
    PathTracing how;
    how.samples = 4096;
    const LightSurvey truth =
        PathTracer(scene, visibility, lights).indirect_to(target, points, how);
    std::vector<double> wanted;
    for (const LightEstimate& estimate : truth.at)
        wanted.push_back(estimate.mean[0]);
    const Lighting lighting = lit.light(lights);
    return {{"wall, one and two leaves from the slab, measured",
             worst_ratio(lit.gathered(lighting, points), wanted), 0.01},
            {"wall, one and two leaves from the slab, shown",
             worst_ratio(lit.shown(lighting, points), wanted), 0.05}};
}

}  // namespace lightwell::stability
