// What truncation costs is measured on lights.
#include "solver/series/trial_lights.h"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/unit/basis/samples.h"

namespace lightwell {
namespace {

constexpr int size = 12;

/// A symmetric operator of norm below one, all coefficients stored.
SymmetricOperator sample_bounce() {
    testing::Numbers numbers(3);
    Eigen::SparseMatrix<double> upper(size, size);
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < j; ++i)
            upper.insert(i, j) = numbers.between(0, 0.15);
    upper.makeCompressed();
    return {to_operator(upper)};
}

std::vector<Eigen::ArrayXd> sample_fields(int count) {
    testing::Numbers numbers(4);
    std::vector<Eigen::ArrayXd> fields;
    for (int k = 0; k < count; ++k) {
        fields.emplace_back(size);
        for (double& value : fields.back())
            value = numbers.between(-1, 1);
    }
    return fields;
}

/// (I - T)^-1 T E by a dense solver.
Eigen::MatrixXd dense_indirect(const Eigen::MatrixXd& transport,
                               const std::vector<Eigen::ArrayXd>& fields) {
    Eigen::MatrixXd direct(size, static_cast<Eigen::Index>(fields.size()));
    for (std::size_t k = 0; k < fields.size(); ++k)
        direct.col(static_cast<Eigen::Index>(k)) = fields[k].matrix();
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(size, size);
    return (identity - transport).lu().solve(transport * direct);
}

TEST(TrialLights, SolvesAsADenseSolverDoes) {
    const SymmetricOperator bounce = sample_bounce();
    const Eigen::ArrayXd reflectance = Eigen::ArrayXd::LinSpaced(size, 0.1, 0.9);
    const auto fields = sample_fields(11);  // two blocks, the second not full
    const Eigen::SparseMatrix<double> transport = to_matrix(bounce, reflectance);
    const Eigen::MatrixXd exact = dense_indirect(Eigen::MatrixXd(transport), fields);
    const TrialLights direct = trial_lights(fields);
    ASSERT_EQ(direct.size(), 2U);
    // Plainly, and corrected by an H that holds the first two bounces only.
    const Eigen::SparseMatrix<double> two_bounces =
        transport + Eigen::SparseMatrix<double>(transport * transport);
    const Eigen::SparseMatrix<double>* const accelerators[] = {nullptr, &two_bounces};
    for (const Eigen::SparseMatrix<double>* global : accelerators) {
        const TrialLights solved = solved_indirect(bounce, reflectance, global, direct, {});
        for (Eigen::Index k = 0; k < 11; ++k)
            EXPECT_LT(
                (solved[static_cast<std::size_t>(k / 8)].col(k % 8).matrix() - exact.col(k)).norm(),
                1e-3 * exact.col(k).norm())
                << k;
    }
}

TEST(TrialLights, ChangeIsTheRootMeanSquareOverLights) {
    std::vector<Eigen::ArrayXd> reference = sample_fields(2), changed = reference;
    reference[0] *= 3 / reference[0].matrix().norm();
    reference[1] *= 4 / reference[1].matrix().norm();
    changed[0] = 1.1 * reference[0];
    changed[1] = 0.8 * reference[1];
    EXPECT_NEAR(relative_change(trial_lights(changed), trial_lights(reference)),
                std::sqrt((0.01 + 0.04) / 2), 1e-12);
    EXPECT_EQ(relative_change(trial_lights(reference), trial_lights(reference)), 0);
}

TEST(TrialLights, LightsOfNextToNothingCountLittle) {
    std::vector<Eigen::ArrayXd> reference = sample_fields(2);
    reference[0] *= 1 / reference[0].matrix().norm();
    reference[1] *= 1e-6 / reference[1].matrix().norm();
    std::vector<Eigen::ArrayXd> changed = reference;
    changed[1] *= 2;
    EXPECT_LT(relative_change(trial_lights(changed), trial_lights(reference)), 1e-5);
}

TEST(TrialLights, TruncatedIndirectLeavesOutWhatTheRuleDrops) {
    const Eigen::SparseMatrix<double> global =
        to_matrix(sample_bounce(), Eigen::ArrayXd::Ones(size));
    TruncationRule rule;
    rule.weight = Eigen::ArrayXd::LinSpaced(size, 0.5, 1.5);
    rule.threshold = 0.06;
    rule.is_mean.assign(size, false);
    rule.is_mean[0] = rule.is_mean[5] = true;
    const auto fields = sample_fields(3);
    const TrialLights result = truncated_indirect(global, rule, trial_lights(fields));
    const Eigen::SparseMatrix<double> kept = truncated(global, rule);
    ASSERT_LT(kept.nonZeros(), global.nonZeros());
    for (Eigen::Index k = 0; k < 3; ++k)
        EXPECT_LT((result[0].col(k).matrix() - kept * fields[static_cast<std::size_t>(k)].matrix())
                      .norm(),
                  1e-12);
}

TEST(CalibratedThreshold, FindsWhereAPowerLawReachesTheError) {
    for (const double power : {0.4, 0.7, 1.5}) {
        for (const double guess : {1e-4, 1.0, 30.0}) {
            int trials = 0;
            const double wanted = 0.02;
            const double found = calibrated_threshold(guess, wanted, [&](double at) {
                ++trials;
                return std::pow(at, power);
            });
            const double exact = std::pow(wanted, 1 / power);
            EXPECT_LE(found, exact) << power << " from " << guess;
            EXPECT_GT(found, 0.8 * exact) << power << " from " << guess;
            EXPECT_LE(trials, 8);
        }
    }
}

TEST(CalibratedThreshold, IsZeroWhereTheErrorIsNeverReached) {
    EXPECT_EQ(calibrated_threshold(1, 0.01, [](double) { return 0.5; }), 0);
}

}  // namespace
}  // namespace lightwell
