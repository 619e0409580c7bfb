#include "solver/reference/deviation.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

// Values 3 % off, a reference with 5 % noise: the noise is taken out of what is measured.
TEST(Deviation, TakesTheNoiseOfTheReferenceOut) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    std::vector<LightEstimate> reference;
    std::vector<Rgb> values;
    for (int k = 0; k < 20000; ++k) {
        const double truth = 1 + k % 7;
        Rgb seen;
        for (double& channel : seen)
            channel = truth * (1 + 0.05 * normal(random));
        reference.push_back({seen, Rgb::Constant(0.05 * truth)});
        values.push_back(Rgb::Constant(truth * (k % 2 == 0 ? 1.03 : 0.97)));
    }
    const Deviation found = deviation_from(reference, values);
    EXPECT_NEAR(found.relative_rms, 0.03, 0.001);
    EXPECT_NEAR(found.noise, 0.05, 0.001);
}

TEST(Deviation, OfExactValuesIsZero) {
    const std::vector<LightEstimate> reference{{Rgb(1, 2, 3), Rgb::Zero()}};
    EXPECT_EQ(deviation_from(reference, {Rgb(1, 2, 3)}).relative_rms, 0);
    const Deviation tenth = deviation_from(reference, {Rgb(1.1, 2.2, 3.3)});
    EXPECT_NEAR(tenth.relative_rms, 0.1, 1e-12);
    EXPECT_NEAR(tenth.bias, 0.1, 1e-12);
    EXPECT_NEAR(tenth.reference_rms, std::sqrt(14.0 / 3), 1e-12);
    EXPECT_NEAR(deviation_from(reference, {Rgb(2, 1, 3)}).bias, 0, 1e-12);
}

TEST(Deviation, CountsPointsByTheirWeight) {
    const LightEstimate one{Rgb::Ones(), Rgb::Zero()};
    const std::vector<Rgb> values{Rgb::Constant(1.1), Rgb::Constant(5), Rgb::Constant(0.8)};
    const Deviation found = deviation_from({one, one, one}, values, {3, 0, 1});
    EXPECT_NEAR(found.relative_rms, std::sqrt((3 * 0.01 + 0.04) / 4), 1e-12);
    EXPECT_NEAR(found.bias, 0.1 / 4, 1e-12);
    EXPECT_NEAR(found.reference_rms, 1, 1e-12);
}

TEST(Deviation, FromTheDarkIsNothing) {
    const std::vector<LightEstimate> dark(3);
    const Deviation none = deviation_from(dark, {Rgb::Ones(), Rgb::Ones(), Rgb::Ones()});
    EXPECT_EQ(none.reference_rms, 0);
    EXPECT_EQ(none.relative_rms, 0);
}

}  // namespace
}  // namespace lightwell
