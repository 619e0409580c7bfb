#include "solver/series/truncation.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/unit/basis/samples.h"

namespace lightwell {
namespace {

double cost_of(const std::vector<double>& magnitudes, double threshold) {
    double squares = 0;
    for (const double m : magnitudes)
        if (m < threshold) squares += m * m;
    return std::sqrt(squares);
}

TEST(ThresholdForBudget, SpendsTheBudgetAndNoMore) {
    testing::Numbers numbers(30);
    std::vector<double> magnitudes;
    for (int k = 0; k < 1000; ++k)
        magnitudes.push_back(std::pow(numbers.between(0, 1), 4));
    for (const double budget : {1e-6, 1e-3, 0.1, 1.0, 5.0}) {
        const double threshold = threshold_for_budget(magnitudes, budget);
        EXPECT_LE(cost_of(magnitudes, threshold), budget);
        // The largest such: the next magnitude would be too much.
        EXPECT_GT(cost_of(magnitudes, std::nextafter(threshold, 2.0)), budget);
    }
}

TEST(ThresholdForBudget, OrderDoesNotMatter) {
    EXPECT_EQ(threshold_for_budget({3, 1, 2, 4}, 2.5), threshold_for_budget({4, 3, 2, 1}, 2.5));
    EXPECT_EQ(threshold_for_budget({3, 1, 2, 4}, 2.5), 3);
}

TEST(ThresholdForBudget, Ends) {
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(threshold_for_budget({}, 1), infinity);
    EXPECT_EQ(threshold_for_budget({1, 2}, 3), infinity);
    EXPECT_EQ(threshold_for_budget({1, 2}, 1), 2);
    // Without a budget nothing that is not zero may go.
    const double none = threshold_for_budget({0, 0, 0.5, 2}, 0);
    EXPECT_LE(none, 0.5);
    EXPECT_EQ(cost_of({0, 0, 0.5, 2}, none), 0);
}

}  // namespace
}  // namespace lightwell
