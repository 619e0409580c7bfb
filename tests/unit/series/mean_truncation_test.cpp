#include "solver/series/mean_truncation.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/unit/basis/samples.h"

namespace lightwell {
namespace {

constexpr Eigen::Index size = 60, means = 20;

/// Positive where means meet, of sizes from 1e-6 to 1; anything elsewhere.
Eigen::MatrixXd sample_matrix() {
    testing::Numbers numbers(7);
    Eigen::MatrixXd matrix(size, size);
    for (Eigen::Index i = 0; i < size; ++i)
        for (Eigen::Index j = 0; j < size; ++j)
            matrix(i, j) = i < means && j < means ? std::pow(10, numbers.between(-6, 0))
                                                  : numbers.between(-1e-6, 1e-6);
    return matrix;
}

TruncationRule sample_rule() {
    testing::Numbers numbers(8);
    TruncationRule rule;
    rule.weight = Eigen::ArrayXd(size);
    rule.is_mean.assign(static_cast<std::size_t>(size), false);
    for (Eigen::Index j = 0; j < size; ++j) {
        rule.weight[j] = numbers.between(0.1, 2);
        rule.is_mean[static_cast<std::size_t>(j)] = j < means;
    }
    return rule;
}

Eigen::MatrixXd without(const Eigen::MatrixXd& matrix, double share) {
    return without_small_means(matrix.sparseView(1, 0), sample_rule(), share);
}

TEST(MeanTruncation, TakesAsManyOfEachRowAsTheShareAllows) {
    const Eigen::MatrixXd matrix = sample_matrix();
    const TruncationRule rule = sample_rule();
    for (const double share : {0.001, 0.01, 0.2}) {
        const Eigen::MatrixXd left = without(matrix, share);
        bool any_gone = false;
        for (Eigen::Index i = 0; i < means; ++i) {
            double all = 0, gone = 0, largest_gone = 0;
            double smallest_left = std::numeric_limits<double>::infinity();
            for (Eigen::Index j = 0; j < means; ++j) {
                const double expected = matrix(i, j) * rule.weight[j];
                all += expected;
                if (left(i, j) == 0) {
                    gone += expected;
                    largest_gone = std::max(largest_gone, expected);
                    any_gone = true;
                } else {
                    EXPECT_EQ(left(i, j), matrix(i, j));
                    smallest_left = std::min(smallest_left, expected);
                }
            }
            EXPECT_LE(gone, share * all);
            EXPECT_GT(gone + smallest_left, share * all) << "one more could have gone";
            EXPECT_LT(largest_gone, smallest_left);
        }
        EXPECT_TRUE(any_gone);
    }
}

TEST(MeanTruncation, LeavesAllThatIsNotBetweenMeans) {
    const Eigen::MatrixXd matrix = sample_matrix();
    const Eigen::MatrixXd left = without(matrix, 0.5);
    EXPECT_EQ(left.rightCols(size - means), matrix.rightCols(size - means));
    EXPECT_EQ(left.bottomRows(size - means), matrix.bottomRows(size - means));
    EXPECT_EQ(without(matrix, 0), matrix);
}

// The faces of a small block receive little, and must not go dark for it.
TEST(MeanTruncation, CountsARowByItsOwnLight) {
    Eigen::MatrixXd matrix = sample_matrix();
    const Eigen::MatrixXd left = without(matrix, 0.1);
    matrix.row(3) *= 1e-9;
    const Eigen::MatrixXd dim = without(matrix, 0.1);
    EXPECT_EQ((dim.row(3).array() == 0).count(), (left.row(3).array() == 0).count());
    EXPECT_GT((dim.row(3).leftCols(means).array() > 0).count(), 0);
}

}  // namespace
}  // namespace lightwell
