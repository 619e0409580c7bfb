#include "runtime/propagation/paced_budget.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

TEST(PacedBudget, LearnsWhatACoefficientTakes) {
    PacedBudget pace;
    for (const double each : {3e-6, 2e-7}) {
        for (int frame = 0; frame < 40; ++frame) {
            const std::uint32_t budget = pace.budget(1e-3);
            pace.took(budget, budget * each);
        }
        EXPECT_NEAR(pace.budget(1e-3), 1e-3 / each, 0.02 * 1e-3 / each);
        EXPECT_NEAR(pace.budget(5e-4), 5e-4 / each, 0.02 * 5e-4 / each);
    }
}

TEST(PacedBudget, OneSlowFrameIsNotTakenForAll) {
    PacedBudget pace;
    for (int frame = 0; frame < 40; ++frame)
        pace.took(100, 1e-4);
    const double usual = pace.budget(1e-3);
    pace.took(100, 1e-2);
    EXPECT_GT(pace.budget(1e-3), 0.3 * usual);
}

TEST(PacedBudget, IsNeverNothingAndHeedsNoFrameOfFew) {
    PacedBudget pace;
    for (int frame = 0; frame < 40; ++frame)
        pace.took(1, 1);
    EXPECT_GT(pace.budget(1e-3), 100u);
    for (int frame = 0; frame < 100; ++frame)
        pace.took(100, 1e3);
    EXPECT_EQ(pace.budget(1e-6), 1u);
}

}  // namespace
}  // namespace lightwell
