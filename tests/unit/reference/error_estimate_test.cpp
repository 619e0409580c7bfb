#include "solver/reference/error_estimate.h"

#include <cmath>

#include <gtest/gtest.h>

#include "radiance4d/scene/scene_quads.h"
#include "solver/precompute.h"
#include "tests/unit/reference/rooms.h"

namespace lightwell {
namespace {

TEST(ErrorEstimate, CountsALightAsOftenAsItsWeightSays) {
    ErrorEstimate weighed, repeated;
    weighed.squares = {{0.04, 3}, {0.01, 1}, {0.25, 2}};
    repeated.squares = {{0.04}, {0.04}, {0.04}, {0.01}, {0.25}, {0.25}};
    EXPECT_DOUBLE_EQ(weighed.rms(), std::sqrt((3 * 0.04 + 0.01 + 2 * 0.25) / 6));
    EXPECT_DOUBLE_EQ(weighed.rms(), repeated.rms());
    EXPECT_DOUBLE_EQ(weighed.interval().value, weighed.rms());
    EXPECT_GT(weighed.interval().high, weighed.rms());
}

TEST(ErrorEstimate, NineLightsOfTenStayBelowWhatItSays) {
    ErrorEstimate even;
    for (int k = 0; k <= 100; ++k)
        even.squares.push_back({std::pow(k / 100.0, 2), 3});
    EXPECT_NEAR(even.ninth_of_ten(), 0.9, 1e-12);
    // A rare light, drawn oftener than it is there, does not count for many.
    ErrorEstimate rare;
    rare.squares = {{1, 0.5}, {0.01, 10}, {0.01, 10}};
    EXPECT_NEAR(rare.ninth_of_ten(), 0.1, 1e-12);
    rare.squares.front().weight = 10;
    EXPECT_NEAR(rare.ninth_of_ten(), 0.82, 1e-12);  // from 0.1 in the middle to 1 at the end
    rare.squares.resize(1);
    EXPECT_EQ(rare.ninth_of_ten(), 1);
    EXPECT_EQ(ErrorEstimate{}.ninth_of_ten(), 0);
}

std::vector<double> stakes_in_a_room(double truncation, double cell_size) {
    std::array<Rgb, 6> grey;
    grey.fill(Rgb::Constant(0.4));
    const Scene scene = box_scene({3, 2, 2.5}, grey);
    const std::vector<Quad> quads = quads_of(scene);
    PrecomputeOptions options;
    options.most_attempts = 0;
    options.error = 0.3;
    options.cell_size = cell_size;
    options.truncation = truncation;
    PrecomputeReport report;
    // In the middle, close to a wall, in a corner.
    return lamp_stakes(precompute(scene, options, {}, report), quads, OccluderTree(quads),
                       {{1.5, 1, 1.2}, {0.1, 1, 1.2}, {2.9, 1.9, 2.4}});
}

// Nothing is left out, and one cell a wall has no details: the series is summed to its end.
TEST(LampStakes, AreNoughtWhereNothingIsLeftOutAndNothingIsFine) {
    for (const double stake : stakes_in_a_room(0, 4))
        EXPECT_LT(stake, 1e-5);
    for (const double stake : stakes_in_a_room(0.3, 1))
        EXPECT_GT(stake, 1e-3);
}

TEST(LampStakes, AreMoreCloseToAWallAndLessWhereCellsAreFiner) {
    const std::vector<double> coarse = stakes_in_a_room(0.02, 0.8),
                              fine = stakes_in_a_room(0.02, 0.2);
    for (const std::vector<double>& stakes : {coarse, fine}) {
        EXPECT_GT(stakes[1], 2 * stakes[0]);
        EXPECT_GT(stakes[2], 2 * stakes[0]);
    }
    // Cells a quarter as wide: the square of details falls by up to 4^2 in the middle.
    EXPECT_LT(fine[0], coarse[0] / 4);
    for (const std::size_t close : {1, 2})
        EXPECT_LT(fine[close], 0.7 * coarse[close]);
}

}  // namespace
}  // namespace lightwell
