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
    DirectedWeights weights_of(const std::vector<TrialLights>& groups) const {
        DirectedEnsemble ensemble(transport.bounce, transport.space, transport.reflection);
        for (const TrialLights& lights : groups)
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
    const DirectedWeights together = weights_of({trial_lights({one, other})});
    const DirectedWeights apart = weights_of({trial_lights({one}), trial_lights({other})});
    const DirectedWeights alone = weights_of({trial_lights({one})});
    EXPECT_LT(difference(apart.direct, together.direct), 0.02);
    EXPECT_LT(difference(apart.outgoing, together.outgoing), 0.02);
    EXPECT_GT(difference(alone.direct, together.direct), 0.1);
    // A light that nothing reflects counts for nothing.
    const TrialLights dark = trial_lights({Eigen::ArrayXd::Zero(one.size())});
    EXPECT_EQ(difference(weights_of({dark, trial_lights({one})}).direct, alone.direct), 0);
    EXPECT_TRUE((weights_of({dark}).direct == 1).all());
}

// However much is left out: of more than 400 elements, the means of the 400 largest stay.
TEST_F(DirectedSeries, KeepsTheMeansOfTheLargestElements) {
    ASSERT_EQ(transport.space.elements().size(), std::size_t{6 + plates});
    const TrialLights lights = trial_lights({light_at({1, 1, 1}), light_at({2, 2, 1.5})});
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
