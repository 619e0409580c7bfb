#include "solver/reference/deviation.h"

#include <random>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

// Values 3 % off, a reference with 5 % noise: the noise is taken out of what is measured.
TEST(Deviation, TakesTheNoiseOfTheReferenceOut) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    std::vector<IrradianceEstimate> reference;
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
    const std::vector<IrradianceEstimate> reference{{Rgb(1, 2, 3), Rgb::Zero()}};
    EXPECT_EQ(deviation_from(reference, {Rgb(1, 2, 3)}).relative_rms, 0);
    EXPECT_NEAR(deviation_from(reference, {Rgb(1.1, 2.2, 3.3)}).relative_rms, 0.1, 1e-12);
}

}  // namespace
}  // namespace lightwell
