// Coefficients of many blocks in the order that operators are stored in.
#include "solver/transport/coefficients.h"

#include <tuple>

#include <gtest/gtest.h>

#include "tests/unit/basis/samples.h"

namespace lightwell {
namespace {

TEST(Coefficients, AreJoinedByColumnThenRow) {
    constexpr std::uint32_t columns = 600;  // more than are sorted at a time
    std::vector<std::vector<Coefficient>> blocks(5);
    std::vector<Coefficient> expected;
    testing::Numbers numbers(7);
    for (std::uint32_t column = 0; column < columns; column += 2)  // the others stay empty
        for (std::uint32_t row = 0; row < column; row += 7) {
            const auto block = static_cast<std::size_t>(numbers.between(0, 4.999));
            const Coefficient c{row, column, static_cast<float>(numbers.between(-1, 1))};
            blocks[block].insert(blocks[block].begin(), c);
            expected.push_back(c);
        }
    const std::vector<Coefficient> all = joined(blocks, columns);
    ASSERT_EQ(all.size(), expected.size());
    for (std::size_t k = 0; k < all.size(); ++k)
        EXPECT_EQ(std::tie(all[k].row, all[k].column, all[k].value),
                  std::tie(expected[k].row, expected[k].column, expected[k].value));
    EXPECT_TRUE(joined({{}, {}}, 3).empty());
}

}  // namespace
}  // namespace lightwell
