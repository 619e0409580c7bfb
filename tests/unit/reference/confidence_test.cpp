#include "solver/reference/confidence.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

// Tables of Student's distribution.
TEST(Confidence, KnowsStudentsQuantile) {
    EXPECT_NEAR(student_quantile(3), 3.1824, 0.03);
    EXPECT_NEAR(student_quantile(9), 2.2622, 1e-3);
    EXPECT_NEAR(student_quantile(39), 2.0227, 1e-4);
    EXPECT_NEAR(student_quantile(100000), 1.9600, 1e-4);
}

TEST(Confidence, OfTheMeanIsStudents) {
    const Interval interval = mean_interval({{1}, {2}, {3}, {4}, {5}});
    EXPECT_DOUBLE_EQ(interval.value, 3);
    // s = sqrt(2.5), t = 2.776
    EXPECT_NEAR(interval.high - 3, 2.776 * std::sqrt(2.5 / 5), 0.02);
    EXPECT_NEAR(interval.high + interval.low, 6, 1e-12);
}

TEST(Confidence, OfEqualErrorsIsAPoint) {
    const Interval interval = rms_interval(std::vector<WeighedValue>(9, {0.04, 1}));
    EXPECT_NEAR(interval.value, 0.2, 1e-12);
    EXPECT_NEAR(interval.low, 0.2, 1e-6);
    EXPECT_NEAR(interval.high, 0.2, 1e-6);
}

TEST(Confidence, OfErrorsBelowTheNoiseReachesDownToNothing) {
    const Interval interval = rms_interval({{-0.01}, {0.012}, {-0.005}, {0.006}, {0.001}});
    EXPECT_EQ(interval.low, 0);
    EXPECT_GT(interval.high, interval.value);
}

/// How many of 1,000 intervals contain the root mean square of a population of errors whose
/// logarithm is normal, each seen once through noise.
int covered(int lights, double spread, double noise) {
    std::mt19937 random(2006);
    std::normal_distribution<double> normal;
    // E[e^2] of e = exp(spread z): exp(2 spread^2).
    const double truth = std::exp(spread * spread);
    int hits = 0;
    for (int repetition = 0; repetition < 1000; ++repetition) {
        std::vector<WeighedValue> squares;
        for (int k = 0; k < lights; ++k)
            squares.push_back({std::exp(2 * spread * normal(random)) + noise * normal(random)});
        const Interval interval = rms_interval(squares);
        if (interval.low <= truth && truth <= interval.high) ++hits;
    }
    return hits;
}

// Numbers 1 to 4, drawn with chances 1, 1/2, 1/4 and 1/4: weighed by the inverse, their mean
// is 2.5.
TEST(Confidence, CountsSamplesByTheInverseOfTheirChance) {
    const Interval interval =
        mean_interval({{1, 1}, {1, 1}, {1, 1}, {1, 1}, {2, 2}, {2, 2}, {3, 4}, {4, 4}});
    EXPECT_DOUBLE_EQ(interval.value, 2.5);
    EXPECT_LT(interval.low, 2);
    EXPECT_GT(interval.high, 3);
}

TEST(Confidence, ContainsTheTrueErrorInNinetyThreeOfAHundredRepetitions) {
    EXPECT_GE(covered(40, 0.25, 0), 930);
    EXPECT_GE(covered(40, 0.4, 0.5), 930);
    EXPECT_GE(covered(20, 0.25, 0.2), 930);
    // Where a few of a hundred lamps make most of the error.
    EXPECT_GE(covered(40, 0.6, 0), 930);
    EXPECT_GE(covered(16, 0.5, 0), 930);
    // Nor is it needlessly wide.
    EXPECT_LE(covered(40, 0.25, 0), 975);
}

TEST(Quantile, CountsValuesByTheirWeight) {
    const std::vector<WeighedValue> values{{4, 1}, {1, 1}, {3, 0}, {2, 2}};
    EXPECT_EQ(quantile_of(values, 0.25), 1);
    EXPECT_EQ(quantile_of(values, 0.5), 2);
    EXPECT_EQ(quantile_of(values, 0.76), 4);
    EXPECT_EQ(quantile_of(values, 1), 4);
    EXPECT_EQ(quantile_of({}, 0.5), 0);
    EXPECT_EQ(quantile_of({{7, 0}}, 0.5), 0);
}

}  // namespace
}  // namespace lightwell
