// The series of scenes with gloss: what steers its truncation, and what is never left out.
#include "solver/series/directed_series.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "radiance4d/operator/light_projection.h"
#include "solver/radiance_bounce.h"
#include "tests/unit/reference/rooms.h"

namespace lightwell {
namespace {

constexpr int plates = 441;

/// A room with a glossy floor, and plates of ever larger size that hang below its ceiling.
Scene room_with_plates() {
    std::array<Rgb, 6> rho;
    rho.fill(Rgb::Constant(0.5));
    Scene scene = box_scene({3, 3, 2.5}, rho);
    scene.materials[floor_z0].lobe = PhongLobe{Rgb::Constant(0.3), 2};
    constexpr int side = 21;
    for (int k = 0; k < plates; ++k) {
        const double half = 0.01 + 4e-5 * k;
        const Vec3 at(0.15 + 0.13 * (k % side), 0.15 + 0.13 * (k / side), 2.3);
        add_quad(scene,
                 {{at + Vec3(-half, -half, 0), at + Vec3(-half, half, 0), at + Vec3(half, half, 0),
                   at + Vec3(half, -half, 0)}},
                 Rgb::Constant(0.5));
    }
    for (Material& material : scene.materials)
        material.reflecting = Sides::front;
    return scene;
}

/// Whether H has a coefficient there.
bool holds(const TransportOperator& indirect, std::uint32_t row, std::uint32_t column) {
    const auto begin = indirect.row.begin() +
                       static_cast<std::ptrdiff_t>(indirect.column_start[column]),
               end = indirect.row.begin() +
                     static_cast<std::ptrdiff_t>(indirect.column_start[column + 1]);
    return std::find(begin, end, row) != end;
}

class DirectedSeries : public ::testing::Test {
  protected:
    DirectedSeries() {
        RadianceBounceOptions options;
        options.cell_size = 4;
        RadianceBounce bounce = radiance_bounce(ground, options);
        transport.scene = scene;
        transport.space = std::move(bounce.space);
        transport.bounce = std::move(bounce.propagation);
        transport.reflection = Reflection(transport.scene, transport.space);
    }

    Eigen::ArrayXd light_at(const Vec3& position) const {
        return projected_lights(transport.space, {lamp_at(position)}, ground.quads,
                                ground.occluders)
            .col(1);
    }
    DirectedWeights weights_of(const std::vector<std::vector<DirectedLights>>& groups) const {
        DirectedEnsemble ensemble(transport.bounce, transport.space, transport.reflection);
        for (const std::vector<DirectedLights>& lights : groups)
            ensemble.add(lights, {});
        return ensemble.weights();
    }

    const Scene scene = room_with_plates();
    OracleCost cost;
    const Ground ground{scene, cost};
    GlobalTransport transport;
};

double difference(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) {
    return (a - b).matrix().norm() / b.matrix().norm();
}

// Lights may come in groups: but for the iteration's tolerance nothing changes.
TEST_F(DirectedSeries, WeighsLightsOneByOneAsTogether) {
    const Eigen::ArrayXd one = light_at({1, 1, 1}), other = light_at({2, 2, 1.5});
    const DirectedWeights together = weights_of({{DirectedLights::of({one, other})}});
    const DirectedWeights apart =
        weights_of({{DirectedLights::of({one})}, {DirectedLights::of({other})}});
    const DirectedWeights alone = weights_of({{DirectedLights::of({one})}});
    EXPECT_LT(difference(apart.direct, together.direct), 0.02);
    EXPECT_LT(difference(apart.outgoing, together.outgoing), 0.02);
    EXPECT_GT(difference(alone.direct, together.direct), 0.1);
    // A light that nothing reflects counts for nothing.
    const DirectedLights dark = DirectedLights::of({Eigen::ArrayXd::Zero(one.size())});
    EXPECT_EQ(difference(weights_of({{dark}, {DirectedLights::of({one})}}).direct, alone.direct),
              0);
    EXPECT_TRUE((weights_of({{dark}}).direct == 1).all());
}

// Where P has no coefficients there is no light to solve for; elsewhere it is what full fields
// give.
TEST_F(DirectedSeries, SolvesForWhatPlainIterationGives) {
    // Of P, only what the floor and one wall exchange.
    const Element& floor = transport.space.element(
        static_cast<std::size_t>(transport.space.element_on(floor_z0, true)));
    const Element& wall =
        transport.space.element(static_cast<std::size_t>(transport.space.element_on(x0, true)));
    const auto is_of = [](const Element& element, std::uint32_t function) {
        return function >= element.first && function < element.first + element.functions();
    };
    SymmetricOperator between;
    TransportOperator& upper = between.upper;
    const TransportOperator& all = transport.bounce.upper;
    upper.size = all.size;
    upper.column_start.assign(1, 0);
    for (std::uint32_t column = 0; column < all.size; ++column) {
        for (std::uint64_t k = all.column_start[column]; k < all.column_start[column + 1]; ++k) {
            if (!(is_of(floor, all.row[k]) && is_of(wall, column)) &&
                !(is_of(wall, all.row[k]) && is_of(floor, column)))
                continue;
            upper.row.push_back(all.row[k]);
            upper.value.push_back(all.value[k]);
        }
        upper.column_start.push_back(upper.value.size());
    }
    ASSERT_GT(upper.coefficients(), 10U);

    RadianceField direct(transport.space.functions(), 3);
    direct.col(0) = light_at({1, 1, 1});
    direct.col(1) = light_at({2, 2, 1.5});
    direct.col(2) = Eigen::ArrayXd::Zero(direct.rows());
    const RadianceField expected = bounced_light(between, transport.reflection, direct);
    const std::vector<DirectedLights> lights = {
        DirectedLights::of({direct.col(0), direct.col(1), direct.col(2)})};
    const Rgb green(0, 1, 0);  // the room is grey
    const DirectedSolver solver(between, transport.reflection, green);
    EXPECT_LT(solver.functions().size(), floor.functions() + wall.functions() + 1);
    const DirectedSolver::Fields solved =
        solver.solved(between, solver.reflected(lights), 1e-6, {}).front();
    ASSERT_EQ(solved.rows(), static_cast<Eigen::Index>(solver.functions().size()));
    RadianceField found = RadianceField::Zero(direct.rows(), 3);
    for (std::size_t k = 0; k < solver.functions().size(); ++k)
        found.row(solver.functions()[k]) =
            solved.row(static_cast<Eigen::Index>(k)).head<3>().cast<double>();
    for (int lamp = 0; lamp < 2; ++lamp) {
        ASSERT_GT(expected.col(lamp).matrix().norm(), 0);
        EXPECT_LT(difference(found.col(lamp), expected.col(lamp)), 1e-5);
    }
    EXPECT_TRUE((found.col(2) == 0).all());

    // What H makes of them, without truncation and with all of it truncated.
    TruncationRule rule;
    rule.weight = Eigen::ArrayXd::Ones(direct.rows());
    rule.is_mean.assign(static_cast<std::size_t>(direct.rows()), false);
    Eigen::SparseMatrix<double> halved(direct.rows(), direct.rows());
    const std::uint32_t row = solver.functions().back(), column = lights.front().functions.front();
    halved.insert(row, column) = 0.5;
    const auto of_halved = [&] { return solver.truncated_indirect(halved, rule, lights).front(); };
    EXPECT_FLOAT_EQ(of_halved()(of_halved().rows() - 1, 0),
                    static_cast<float>(0.5 * direct(column, 0)));
    rule.threshold = 1;
    EXPECT_TRUE((of_halved() == 0).all());
}

// However much is left out: of more than 400 elements, the means of the 400 largest stay.
TEST_F(DirectedSeries, KeepsTheMeansOfTheLargestElements) {
    ASSERT_EQ(transport.space.elements().size(), std::size_t{6 + plates});
    const std::vector<DirectedLights> lights = {
        DirectedLights::of({light_at({1, 1, 1}), light_at({2, 2, 1.5})})};
    constexpr double nearly_all = 0.5;
    sum_directed_series(weights_of({lights}), lights, nearly_all, {}, transport);

    const std::uint32_t floor =
        transport.space
            .element(static_cast<std::size_t>(transport.space.element_on(floor_z0, true)))
            .first;
    int large = 0, small = 0;
    constexpr int smallest_left_out = plates + 6 - 400;
    for (int k = 0; k < plates; ++k) {
        const auto e = static_cast<std::size_t>(transport.space.element_on(6 + k, true));
        const std::uint32_t plate = transport.space.element(e).first;
        const bool both = holds(transport.indirect[0], plate, floor) &&
                          holds(transport.indirect[0], floor, plate);
        (k < smallest_left_out ? small : large) += both ? 1 : 0;
    }
    EXPECT_EQ(large, plates - smallest_left_out);
    EXPECT_EQ(small, 0);
}

}  // namespace
}  // namespace lightwell
