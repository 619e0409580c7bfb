// Sparse analysis gives what the full transform gives.
#include "solver/transport/sparse_analysis.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/basis/samples.h"

namespace lightwell {
namespace {

/// The same by spreading every cell over the finest ones and analysing all of them.
Eigen::VectorXd full_analysis(const HaarBasis& basis, const std::vector<SparseValue>& cells) {
    const CellTree& tree = basis.tree();
    RowMatrix rows = RowMatrix::Zero(tree.functions(), 1);
    for (const SparseValue& given : cells) {
        const Cell cell = tree.at(given.index);
        const std::uint32_t each = tree.functions() / tree.cells(cell.level);
        for (std::uint32_t m = cell.index * each; m < (cell.index + 1) * each; ++m)
            rows(m, 0) +=
                given.value * std::sqrt(basis.area({tree.levels(), m}) / basis.area(cell));
    }
    basis.analyse(rows, tree.levels());
    return rows.col(0);
}

TEST(SparseAnalysis, IsTheFullTransform) {
    const CellTree tree({Split::u, Split::both, Split::v, Split::both});
    const HaarBasis basis(testing::trapezoid(), tree);
    SparseAnalysis analyse(basis);
    testing::Numbers numbers(8);
    for (int trial = 0; trial < 20; ++trial) {
        std::vector<SparseValue> cells;
        for (int k = 0; k < 1 + trial; ++k) {
            const auto position = static_cast<std::uint32_t>(
                numbers.between(0, static_cast<double>(tree.positions()) - 1e-9));
            cells.push_back({position, numbers.between(-1, 1)});
        }
        cells.push_back(cells.front());  // cells may repeat
        Eigen::VectorXd sparse = Eigen::VectorXd::Zero(tree.functions());
        std::vector<int> seen(tree.functions(), 0);
        for (const SparseValue& coefficient : analyse(cells)) {
            sparse[coefficient.index] = coefficient.value;
            ++seen[coefficient.index];
        }
        EXPECT_LT((sparse - full_analysis(basis, cells)).norm(), 1e-13) << trial;
        for (const int count : seen)
            EXPECT_LE(count, 1);
    }
}

TEST(SparseAnalysis, CostsWhatIsTouched) {
    const CellTree tree(std::vector<Split>(9, Split::both));
    const HaarBasis basis(testing::unit_square(), tree);
    SparseAnalysis analyse(basis);
    // One finest cell: three wavelets on each level, and the mean.
    EXPECT_EQ(analyse({{tree.positions() - 1, 1.0}}).size(), 3U * 9 + 1);
    EXPECT_TRUE(analyse({}).empty());
}

}  // namespace
}  // namespace lightwell
