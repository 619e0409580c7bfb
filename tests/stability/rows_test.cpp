// Where methods like ours fail: one test per row, which holds what was reached against the
// criterion, or against the known limit where the criterion is out of reach.
#include <cstdio>
#include <ostream>

#include <gtest/gtest.h>

#include "viewer/stability/stability_rows.h"

namespace lightwell::stability {

void PrintTo(const StabilityRow& row, std::ostream* out) {
    *out << row.failure << ", " << row.scene;
}

namespace {

class Stability : public ::testing::TestWithParam<StabilityRow> {};

TEST_P(Stability, HoldsItsCriteria) {
    for (const Finding& finding : GetParam().measure()) {
        std::printf("%s: %s: %.3g of %.3g%s\n", GetParam().name, finding.what.c_str(),
                    finding.reached, finding.wanted,
                    finding.known_limit > 0 ? " (known limit)" : "");
        EXPECT_TRUE(finding.holds())
            << finding.what << ": " << finding.reached << ", not within " << finding.bound();
    }
}

INSTANTIATE_TEST_SUITE_P(Row, Stability, ::testing::ValuesIn(stability_rows()),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace lightwell::stability
