#include "solver/series/neumann_series.h"

#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "radiance4d/failure.h"
#include "tests/unit/basis/samples.h"

namespace lightwell {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using testing::Numbers;

Sparse random_matrix(Numbers& numbers, Eigen::Index n, double density) {
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
            if (numbers.between(0, 1) < density) dense(i, j) = numbers.between(-1, 1);
    return dense.sparseView();
}

/// A random matrix scaled to a spectral radius.
Sparse contraction(unsigned seed, Eigen::Index n, double radius) {
    Numbers numbers(seed);
    const Sparse matrix = random_matrix(numbers, n, 0.3);
    const double now = Eigen::MatrixXd(matrix).eigenvalues().cwiseAbs().maxCoeff();
    return matrix * (radius / now);
}

TruncationRule keep_all(Eigen::Index n) {
    return {Eigen::ArrayXd::Ones(n), 0, std::vector<bool>(static_cast<std::size_t>(n), false)};
}

/// A rule with weights of all sizes and some scaling functions.
TruncationRule sample_rule(Eigen::Index n, double threshold) {
    Numbers numbers(31);
    TruncationRule rule = keep_all(n);
    rule.threshold = threshold;
    for (Eigen::Index j = 0; j < n; ++j) {
        rule.weight[j] = numbers.between(0, 2);
        rule.is_mean[static_cast<std::size_t>(j)] = j % 5 == 0;
    }
    return rule;
}

bool may_go(const TruncationRule& rule, Eigen::Index i, Eigen::Index j, double value) {
    const bool both_means =
        rule.is_mean[static_cast<std::size_t>(i)] && rule.is_mean[static_cast<std::size_t>(j)];
    return !both_means && std::abs(value) * rule.weight[j] < rule.threshold;
}

Eigen::MatrixXd dense_truncated(Eigen::MatrixXd matrix, const TruncationRule& rule) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
        for (Eigen::Index j = 0; j < matrix.cols(); ++j)
            if (may_go(rule, i, j, matrix(i, j))) matrix(i, j) = 0;
    return matrix;
}

double difference(const Sparse& a, const Eigen::MatrixXd& b) {
    return (Eigen::MatrixXd(a) - b).cwiseAbs().maxCoeff();
}

TEST(Truncated, DropsWhatTheRuleSaysAndNothingElse) {
    Numbers numbers(32);
    const Sparse matrix = random_matrix(numbers, 40, 0.5);
    const TruncationRule rule = sample_rule(40, 0.6);
    const Sparse result = truncated(matrix, rule);
    EXPECT_EQ(difference(result, dense_truncated(matrix, rule)), 0);
    EXPECT_LT(result.nonZeros(), matrix.nonZeros());
}

TEST(TruncatedProduct, IsEigensProductTruncated) {
    Numbers numbers(33);
    for (const double threshold : {0.0, 0.3, 2.0}) {
        const Sparse a = random_matrix(numbers, 70, 0.2), b = random_matrix(numbers, 70, 0.3);
        const TruncationRule rule = sample_rule(70, threshold);
        const Sparse full = a * b;
        EXPECT_LT(difference(truncated_product(a, b, rule), dense_truncated(full, rule)), 1e-14);
    }
}

// Term by term: those that are negligible are not there, between means all are.
TEST(TruncatedProduct, LeavesOutTermsThatTheRuleCallsNegligible) {
    constexpr Eigen::Index n = 60;
    Numbers numbers(36);
    const Eigen::MatrixXd a = random_matrix(numbers, n, 0.3), b = random_matrix(numbers, n, 0.3);
    TruncationRule rule = sample_rule(n, 0.5);
    rule.visibility = Eigen::ArrayXd::Ones(n);
    for (Eigen::Index i = 0; i < n; ++i)
        rule.visibility[i] = numbers.between(0.1, 1);
    rule.negligible = 0.4;
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index j = 0; j < n; ++j)
        for (Eigen::Index i = 0; i < n; ++i)
            for (Eigen::Index k = 0; k < n; ++k) {
                const double counts = weighted(rule, i, j, a(i, k) * b(k, j));
                const bool means = rule.is_mean[static_cast<std::size_t>(i)] &&
                                   rule.is_mean[static_cast<std::size_t>(j)];
                if (means || counts >= 0.4 * 0.5) expected(i, j) += a(i, k) * b(k, j);
            }
    const Sparse full = expected.sparseView(0, 0);
    const Sparse result = truncated_product(a.sparseView(), b.sparseView(), rule);
    EXPECT_LT(difference(result, Eigen::MatrixXd(truncated(full, rule))), 1e-13);
    rule.negligible = 0;
    EXPECT_GT(difference(truncated_product(a.sparseView(), b.sparseView(), rule),
                         Eigen::MatrixXd(result)),
              0.01);
}

TEST(TruncatedProduct, IsTheSameForAnyNumberOfThreads) {
    Numbers numbers(34);
    const Sparse a = random_matrix(numbers, 300, 0.1), b = random_matrix(numbers, 300, 0.1);
    const TruncationRule rule = sample_rule(300, 0.2);
    const auto product = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return truncated_product(a, b, rule);
    };
    const Sparse one = product(1), two = product(2);
    EXPECT_EQ(one.nonZeros(), two.nonZeros());
    EXPECT_EQ(difference(one, two), 0);
}

// The series ends where a power is 1e-9 of the first: far below what the floats of a file hold.
TEST(NeumannSeries, WithoutTruncationIsTheInverse) {
    for (const double radius : {0.1, 0.5, 0.9, 0.99}) {
        const Sparse t = contraction(35, 50, radius);
        const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(50, 50);
        const Eigen::MatrixXd exact = (identity - Eigen::MatrixXd(t)).inverse() - identity;
        const NeumannSeries series = neumann_series(t, keep_all(50), {});
        EXPECT_LT(difference(series.sum, exact), 1e-8 * exact.cwiseAbs().maxCoeff())
            << "spectral radius " << radius;
    }
}

TEST(NeumannSeries, GoesUntilAPowerIsBelowTheThreshold) {
    // A single number T = 1/2: T^8 = 0.0039, T^16 = 0.000015.
    Sparse half(1, 1);
    half.insert(0, 0) = 0.5;
    TruncationRule rule = keep_all(1);
    rule.threshold = 1e-3;
    const NeumannSeries series = neumann_series(half, rule, {});
    EXPECT_EQ(series.bounces, 16);
    EXPECT_NEAR(series.sum.coeff(0, 0), 1 - std::pow(0.5, 16), 1e-15);
    rule.threshold = 0.01;
    EXPECT_EQ(neumann_series(half, rule, {}).bounces, 8);
    // A weight makes the same coefficient matter more.
    rule.weight[0] = 100;
    EXPECT_EQ(neumann_series(half, rule, {}).bounces, 16);
}

TEST(NeumannSeries, HoldsEveryBounceOfAChain) {
    // Light runs from function to function: T^k is one diagonal, T^11 is nothing.
    Sparse chain(11, 11);
    for (int i = 0; i + 1 < 11; ++i)
        chain.insert(i + 1, i) = 0.9;
    const NeumannSeries series = neumann_series(chain, keep_all(11), {});
    EXPECT_GE(series.bounces, 10);
    for (int i = 0; i < 11; ++i)
        for (int j = 0; j < 11; ++j)
            EXPECT_NEAR(series.sum.coeff(i, j), i > j ? std::pow(0.9, i - j) : 0, 1e-14);
}

TEST(NeumannSeries, KeepsTheMeansWhateverTheThreshold) {
    const Sparse t = contraction(36, 30, 0.6);
    TruncationRule rule = sample_rule(30, std::numeric_limits<double>::infinity());
    const NeumannSeries series = neumann_series(t, rule, {});
    for (Eigen::Index j = 0; j < 30; ++j)
        for (Sparse::InnerIterator it(series.sum, j); it; ++it)
            EXPECT_TRUE(it.row() % 5 == 0 && j % 5 == 0);
    for (Eigen::Index i = 0; i < 30; i += 5)
        for (Eigen::Index j = 0; j < 30; j += 5)
            if (t.coeff(i, j) != 0) {
                EXPECT_NE(series.sum.coeff(i, j), 0);
            }
}

// All powers of the means are summed too, or the energy of late bounces is lost.
TEST(NeumannSeries, SumsTheMeansOfBrightRoomsToTheEnd) {
    Sparse bright(2, 2);
    bright.insert(0, 1) = 0.95;
    bright.insert(1, 0) = 0.95;
    TruncationRule rule = keep_all(2);
    rule.is_mean = {true, true};
    rule.weight.setConstant(0.01);
    rule.threshold = 0.004;
    const NeumannSeries series = neumann_series(bright, rule, {});
    // What is left out is the tail of powers whose coefficients are below the threshold.
    const double tail = std::pow(0.95, series.bounces);
    EXPECT_LE(tail * 0.01, rule.threshold);
    EXPECT_NEAR(series.sum.coeff(0, 0) + series.sum.coeff(1, 0), 0.95 / 0.05 * (1 - tail), 1e-10);
}

TEST(NeumannSeries, ErrorFollowsTheThreshold) {
    const Sparse t = contraction(37, 60, 0.7);
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(60, 60);
    const Eigen::MatrixXd exact = (identity - Eigen::MatrixXd(t)).inverse() - identity;
    double previous = std::numeric_limits<double>::infinity();
    for (const double threshold : {0.1, 0.03, 0.01, 0.003}) {
        TruncationRule rule = keep_all(60);
        rule.threshold = threshold;
        const NeumannSeries series = neumann_series(t, rule, {});
        const double error = (Eigen::MatrixXd(series.sum) - exact).norm();
        EXPECT_LT(error, 0.6 * previous) << "threshold " << threshold;
        previous = error;
    }
}

TEST(NeumannSeries, StopsWhenAsked) {
    Progress progress;
    progress.stop_requested = [] { return true; };
    EXPECT_THROW(neumann_series(contraction(38, 20, 0.9), keep_all(20), progress), Interrupted);
}

}  // namespace
}  // namespace lightwell
