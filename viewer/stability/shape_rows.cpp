#include "viewer/stability/shape_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/stability/case_scenes.h"
#include "viewer/stability/lit_scene.h"

namespace lightwell::stability {

namespace {

/// Indirect illuminance at a point [lx].
struct OfficeCorner {
    int wall;
    Vec3 at;
    double lux;
};

/// By the continuous solution of the reference, eight digits: a fiftieth of a side from corners.
const std::array<OfficeCorner, 24> office_corners = {{
    {0, {0, .08, .06}, 94.916147124159},  {0, {0, .08, 2.94}, 124.17009783394},
    {0, {0, 3.92, .06}, 90.639598069167}, {0, {0, 3.92, 2.94}, 135.93497172462},
    {1, {5, .08, .06}, 79.906067090475},  {1, {5, .08, 2.94}, 86.868541506299},
    {1, {5, 3.92, .06}, 74.74284050315},  {1, {5, 3.92, 2.94}, 76.590653974257},
    {2, {.1, 0, .06}, 91.637987830094},   {2, {.1, 0, 2.94}, 115.64035208735},
    {2, {4.9, 0, .06}, 70.570927830299},  {2, {4.9, 0, 2.94}, 80.999132990666},
    {3, {.1, 4, .06}, 108.54249109086},   {3, {.1, 4, 2.94}, 162.90509498073},
    {3, {4.9, 4, .06}, 76.47044152427},   {3, {4.9, 4, 2.94}, 85.931753167994},
    {4, {.1, .08, 0}, 128.4393043926},    {4, {.1, 3.92, 0}, 129.97077283633},
    {4, {4.9, .08, 0}, 92.223811150709},  {4, {4.9, 3.92, 0}, 85.001809527144},
    {5, {.1, .08, 3}, 112.75356307216},   {5, {.1, 3.92, 3}, 116.81906649972},
    {5, {4.9, .08, 3}, 76.457513342264},  {5, {4.9, 3.92, 3}, 65.050590505356},
}};

/// The same for a cube of 4 m of reflectance 0.5 with 10,000 lm in its middle, on every wall: at
/// these parameters, of which one quarter is listed.
const std::vector<double> cube_at = {.02, .1, .3, .5, .7, .9, .98};
const std::array<std::array<double, 4>, 4> cube_quarter = {
    {{75.422013329172, 84.765293350077, 96.54384212704, 100.48307592436},
     {84.765293350077, 93.216417469335, 103.85553416494, 107.36822519862},
     {96.54384212704, 103.85553416494, 109.80428278153, 111.33751957325},
     {100.48307592436, 107.36822519862, 111.33751957325, 112.03835692971}}};

struct CubeErrors {
    double edge = 0, median = 0;
};

CubeErrors cube_errors(const std::vector<double>& found) {
    CubeErrors errors;
    std::vector<double> all;
    for (std::size_t j = 0; j < 7; ++j)
        for (std::size_t i = 0; i < 7; ++i) {
            const double wanted = cube_quarter[std::min(j, 6 - j)][std::min(i, 6 - i)];
            const double off = std::abs(found[7 * j + i] / wanted - 1);
            if (std::min({i, 6 - i, j, 6 - j}) == 0) errors.edge = std::max(errors.edge, off);
            all.push_back(off);
        }
    std::sort(all.begin(), all.end());
    errors.median = all[all.size() / 2];
    return errors;
}

}  // namespace

std::vector<Finding> corner_singularity() {
    const Scene cube = room({4, 4, 4}, 0.5);
    const std::vector<Light> in_cube = {lamp({2, 2, 2}, 10000 / (4 * M_PI))};
    const std::vector<SurfacePoint> floor = grid_on(cube, 4, cube_at);
    const LitScene coarse(cube, 0.1), fine(cube, 0.03);
    const CubeErrors shown_coarse = cube_errors(coarse.shown(coarse.light(in_cube), floor));
    const CubeErrors shown_fine = cube_errors(fine.shown(fine.light(in_cube), floor));
    const CubeErrors gathered = cube_errors(fine.gathered(fine.light(in_cube), floor));

    const LitScene lit(office(), 0.03);
    std::vector<SurfacePoint> points;
    std::vector<double> wanted;
    for (const OfficeCorner& corner : office_corners) {
        const Quad& wall = lit.quads()[static_cast<std::size_t>(corner.wall)];
        points.push_back({corner.at, wall.normal(), corner.wall});
        wanted.push_back(corner.lux);
    }
    const std::vector<double> found = lit.gathered(lit.light({lamp(office_lamp())}), points);
    return {
        {"cube, 8 cm from edges, measured", gathered.edge, 0.02},
        {"office, a fiftieth from corners, measured", worst_ratio(found, wanted), 0.02},
        {"cube, near edges over the median, shown", shown_fine.edge / shown_fine.median, 3},
        {"cube, near edges, --error 0.03 over 0.1, shown", shown_fine.edge / shown_coarse.edge, 1}};
}

// What the eye sees of blocks: how far the step between neighbours is off.
std::vector<Finding> blocks() {
    const Scene scene = office();
    const std::vector<Light> lights = {lamp(office_lamp())};
    const LitScene lit(scene, 0.05);
    PrecomputeOptions tight;
    tight.most_attempts = 0;
    tight.cell_size = lit.transport().provenance.cell_size;
    tight.oracle_tolerance = 1e-6;
    tight.truncation = 0.01;
    const LitScene exact(scene, tight);
    const Lighting found_light = lit.light(lights, Propagation::gathered);
    const Eigen::ArrayXd off =
        lit.cells(found_light.indirect) - exact.cells(exact.light(lights).indirect);
    const double mean = lit.mean(found_light.indirect);
    std::vector<double> steps;
    for (const Element& element : lit.transport().space.elements()) {
        const CellTree& tree = element.space.tree();
        const auto at = [&](std::uint32_t i, std::uint32_t j) {
            return off[element.first + tree.finest_at(i, j)];
        };
        for (std::uint32_t j = 0; j + 1 < tree.rows(); ++j)
            for (std::uint32_t i = 0; i + 1 < tree.columns(); ++i) {
                steps.push_back(std::abs(at(i, j) - at(i + 1, j)) / mean);
                steps.push_back(std::abs(at(i, j) - at(i, j + 1)) / mean);
            }
    }
    std::sort(steps.begin(), steps.end());
    double squares = 0;
    for (const double step : steps)
        squares += step * step / static_cast<double>(steps.size());
    return {{"step between leaves less the true one, 99th percentile, gathered",
             steps[steps.size() * 99 / 100], 0.01, 0.04},
            {"the same, root mean square", std::sqrt(squares), 0.01}};
}

namespace {

/// The office with its floor in this many quads, and its walls in two from `knee` on [m].
Scene split_office(int columns, int rows, double knee) {
    Scene scene = office();
    const auto split = [&](std::size_t quad, bool along_u, double at) {
        SceneQuad upper = scene.quads[quad];
        const Quad whole = upper.quad;
        scene.quads[quad].quad = along_u ? whole.part(0, at, 0, 1) : whole.part(0, 1, 0, at);
        upper.quad = along_u ? whole.part(at, 1, 0, 1) : whole.part(0, 1, at, 1);
        scene.quads.push_back(upper);
    };
    if (knee > 0)
        for (const std::size_t wall : {0U, 1U, 2U, 3U}) {
            const Quad& q = scene.quads[wall].quad;
            split(wall, std::abs(q.vertex[1][2] - q.vertex[0][2]) > 1, knee / 3);
        }
    const SceneQuad floor = scene.quads[4];
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            SceneQuad part = floor;
            part.quad = floor.quad.part(
                i / static_cast<double>(columns), (i + 1) / static_cast<double>(columns),
                j / static_cast<double>(rows), (j + 1) / static_cast<double>(rows));
            if (i + j == 0)
                scene.quads[4] = part;
            else
                scene.quads.push_back(part);
        }
    return scene;
}

}  // namespace

std::vector<Finding> t_vertices() {
    const Scene whole = office();
    const std::vector<SurfacePoint> ceiling = grid_on(whole, 5, cube_at);
    std::vector<double> reference;
    double worst = 0, furnace = 0;
    for (const auto& [columns, rows] : {std::pair{1, 1}, std::pair{2, 1}, std::pair{3, 2}}) {
        Scene scene = split_office(columns, rows, columns == 1 ? 0 : 1.37);
        const LitScene lit(scene, 0.05);
        const std::vector<double> found = lit.gathered(lit.light({lamp(office_lamp())}), ceiling);
        if (reference.empty()) reference = found;
        worst = std::max(worst, worst_ratio(found, reference));
        make_furnace(scene);
        furnace = std::max(furnace, ripple_of(LitScene(scene, 0.1)).rms);
    }
    return {{"irradiance of the ceiling, measured", worst, 0.01},
            {"ripple of a furnace with T-vertices", furnace, 1e-5}};
}

// A dark corridor with a screen, so that a part of it is lit a thousand times less than another.
std::vector<Finding> ringing() {
    Scene scene = room({12, 2, 2.8}, 0.2);
    add_quad(scene, rectangle({6, 0.2, 0}, {0, 1.8, 0}, {0, 0, 2.8}), 0.2);
    const LitScene lit(scene, 0.05);
    const std::vector<Light> lights = {lamp({0.5, 1.5, 2})};
    const Lighting solved = lit.light(lights), stored = lit.light(lights, Propagation::stored);
    const auto below = [&](const RadianceField& field) {
        const Eigen::ArrayXd lux = lit.cells(field);
        return std::max(0.0, -lux.minCoeff() / lux.maxCoeff());
    };
    const Eigen::ArrayXd lux = lit.cells(stored.indirect);
    const Eigen::ArrayXd area = lit.cell_areas();
    const double clamped = (area * lux.max(0)).sum() / (area * lux).sum() - 1;
    return {{"negative illuminance of cells, direct", below(solved.direct), 1e-6},
            {"negative illuminance of cells, solved", below(solved.direct + solved.indirect), 1e-6,
             1e-3},
            {"negative illuminance of cells, stored", below(stored.direct + stored.indirect), 1e-6,
             1e-3},
            {"energy that clamping adds, stored", clamped, 1e-3}};
}

}  // namespace lightwell::stability
