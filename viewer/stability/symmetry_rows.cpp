#include "viewer/stability/symmetry_rows.h"

#include <cmath>
#include <limits>

#include "viewer/stability/case_scenes.h"
#include "viewer/stability/lit_scene.h"

namespace lightwell::stability {

std::vector<Finding> reciprocity() {
    Scene scene = office();
    add_block(scene, {1, 1, 0}, {2, 2, 1}, 0.6);
    const LitScene lit(scene, 0.05);
    const GlobalTransport& transport = lit.transport();
    const auto n = static_cast<Eigen::Index>(transport.space.functions());
    const Eigen::ArrayXd rho = reflectance_of(transport.scene, transport.space).col(0);
    double solved = 0, stored = 0, largest = 0;
    const auto exchanged = [&](std::size_t from, std::size_t to, bool exact) {
        RadianceField source = RadianceField::Zero(n, 3);
        source.row(transport.space.element(from).first).setConstant(1);
        const std::uint32_t r = transport.space.element(to).first;
        return (exact ? solved_light(transport, source)
                      : RadianceField(global_light(transport, source) - source))(r, 0) *
               rho[r];
    };
    for (const std::size_t from : {0U, 3U, 7U})
        for (const std::size_t to : {1U, 4U, 8U}) {
            const double forth = exchanged(from, to, true);
            solved = std::max(solved, std::abs(exchanged(to, from, true) / forth - 1));
            largest = std::max(largest, forth);
            stored =
                std::max(stored, std::abs(exchanged(to, from, false) - exchanged(from, to, false)));
        }
    return {{"exchange of two walls there and back, solved", solved, 1e-5},
            {"the same, stored, of the largest", stored / largest, 0.05}};
}

std::vector<Finding> turned_frame() {
    Scene scene = office();
    add_block(scene, {1, 1, 0}, {2, 2, 1}, 0.6);
    const Eigen::Affine3d by = Eigen::Translation3d(1000, -1000, 500) *
                               Eigen::AngleAxisd(37 * M_PI / 180, Vec3(1, 2, 3).normalized());
    const LitScene plain(scene, 0.05), turned(moved(scene, by), 0.05);
    const Vec3 there = by * office_lamp();
    double worst = std::numeric_limits<double>::infinity(), stored = worst;
    if (plain.transport().space.functions() == turned.transport().space.functions()) {
        const auto distance = [&](Propagation how) {
            const RadianceField a = plain.light({lamp(office_lamp())}, how).indirect;
            const RadianceField b = turned.light({lamp(there)}, how).indirect;
            return (a - b).matrix().norm() / a.matrix().norm();
        };
        worst = distance(Propagation::solved);
        stored = distance(Propagation::stored);
    }
    return {{"indirect light of the turned office, solved", worst, 1e-5},
            {"the same, stored", stored, 1e-5}};
}

std::vector<Finding> linearity() {
    const LitScene lit(room({6, 4, 3}, {0.5, 0.5, 0.5, 0.5, 0.25, 0.75}), 0.05);
    PointLight one = lamp({1.5, 2, 2}), other = lamp({4.2, 1.1, 1.6});
    one.intensity = Rgb(1000, 0, 500);
    other.intensity = Rgb(0, 1000, 500);
    double worst = 0;
    for (const Propagation how : {Propagation::solved, Propagation::stored}) {
        const Lighting light = lit.light({one, other}, how);
        const RadianceField x = light.direct + light.indirect;
        worst = std::max(worst, (x.col(2) - 0.5 * (x.col(0) + x.col(1))).matrix().norm() /
                                    x.col(2).matrix().norm());
    }
    return {{"blue against the mean of red and green", worst, 1e-6}};
}

// Rooms of a millimetre and of a kilometre, as they are and away from the origin.
std::vector<Finding> any_scale() {
    Scene scene = room({1, 0.8, 0.6}, 0.7);
    add_block(scene, {0.2, 0.2, 0}, {0.4, 0.4, 0.3}, 0.5);
    const Vec3 place(0.7, 0.5, 0.45);
    Eigen::ArrayXd at_one;
    double worst = 0;
    for (const double scale : {1.0, 1e-3, 1e3})
        for (const bool away : {false, true}) {
            const Eigen::Affine3d by = Eigen::Scaling(scale) *
                                       Eigen::Translation3d(away ? Vec3(50, -20, 5) : Vec3::Zero());
            const LitScene lit(moved(scene, by), 0.1);
            const Lighting lighting = lit.light({lamp(by * place, scale * scale)});
            const Eigen::ArrayXd lux = lit.cells(lighting.indirect);
            if (at_one.size() == 0) at_one = lux;
            worst = std::max(worst, lux.size() == at_one.size()
                                        ? (lux - at_one).matrix().norm() / at_one.matrix().norm()
                                        : std::numeric_limits<double>::infinity());
        }
    return {{"indirect light against the room of 1 m", worst, 1e-4}};
}

std::vector<Finding> nothing_to_see() {
    Scene one;
    add_quad(one, rectangle(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()), 0.5);
    Scene flat = one;
    add_quad(flat, rectangle({2, 0, 0}, Vec3::UnitX(), Vec3::UnitY()), 0.5);
    double coefficients = 0, light = 0;
    for (const Scene& scene : {Scene(), one, flat}) {
        const LitScene lit(scene, 0.05);
        coefficients += static_cast<double>(lit.transport().bounce.coefficients());
        const Lighting lighting = lit.light({lamp({0.5, 0.5, 1})});
        light += lighting.indirect.abs().sum();
    }
    return {{"coefficients of scenes of no quad, one and two that see nothing", coefficients, 0},
            {"indirect light in them", light, 0}};
}

std::vector<Finding> many_lamps() {
    const LitScene lit(office(), 0.1);
    std::vector<Light> lights;
    RadianceField sum;
    for (int k = 0; k < 1000; ++k)
        lights.push_back(
            lamp({0.5 + 4e-3 * k, 0.4 + 3.2 * (k % 10) / 9, 0.5 + 2.0 * (k % 7) / 6}, 1));
    const Lighting all = lit.light(lights), none = lit.light({});
    const double flux = total_flux(lit.transport().space, all.direct)[0] / (4000 * M_PI);
    // In ten groups of a hundred.
    sum = RadianceField::Zero(all.indirect.rows(), 3);
    for (auto first = lights.begin(); first != lights.end(); first += 100)
        sum += lit.light({first, first + 100}).indirect;
    return {{"flux of 1,000 lamps", std::abs(flux - 1), 1e-6},
            {"their indirect light against the sum of ten groups",
             (sum - all.indirect).matrix().norm() / all.indirect.matrix().norm(), 1e-5},
            {"light of no lamp", none.direct.abs().sum() + none.indirect.abs().sum(), 0}};
}

}  // namespace lightwell::stability
