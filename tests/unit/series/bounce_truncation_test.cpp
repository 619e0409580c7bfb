// Coefficients of M are left out by what they carry, and uniform light does not notice.
#include "solver/series/bounce_truncation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "solver/transport/geometric_oracle.h"
#include "solver/transport/refiner.h"
#include "tests/unit/basis/samples.h"
#include "tests/unit/transport/box.h"

namespace lightwell {
namespace {

TEST(BounceTruncation, DropsByTheLargerWeightAndNeverTheMeans) {
    const RadianceSpace space(
        testing::uniform_elements({testing::unit_square(), testing::unit_square().reversed()}, 1));
    const std::uint32_t second = space.element(1).first;
    const std::vector<Coefficient> all = {{0, second, 1e-9F},      {1, second, 0.5F},
                                          {2, second, 0.1F},       {0, second + 1, -0.5F},
                                          {1, second + 1, 0.002F}, {2, second + 1, 0.2F}};
    Eigen::ArrayXd weight = Eigen::ArrayXd::Ones(static_cast<Eigen::Index>(space.functions()));
    weight[1] = 100;  // makes 0.002 count as 0.2
    const SymmetricOperator kept = BounceTruncation(space, {false, false}, all, weight).at(0.15);
    EXPECT_EQ(kept.coefficients(), 5U);
    const Eigen::MatrixXd matrix(
        to_matrix(kept, Eigen::ArrayXd::Ones(static_cast<Eigen::Index>(space.functions()))));
    EXPECT_EQ(matrix(2, second), 0);
    EXPECT_EQ(matrix(0, second), static_cast<double>(1e-9F));
    EXPECT_EQ(matrix(second + 1, 1), static_cast<double>(0.002F));
    EXPECT_EQ((matrix - matrix.transpose()).norm(), 0) << "reciprocity";
}

// Whatever truncation takes, uniform light in a closed room stays uniform; in the open it becomes
// what it became before.
TEST(BounceTruncation, KeepsWhatUniformLightBecomes) {
    const std::vector<Quad> walls = testing::box_walls({3, 2, 2});
    const RadianceSpace space(testing::uniform_elements(walls, 3));
    const Visibility visibility(walls);
    GeometricOracleOptions coarse;
    coarse.tolerance = 1e-3;
    const GeometricOracle oracle(coarse, walls, visibility, space.area());
    OracleCost cost;
    const auto all = direct_transport(
        space, refine_links(space.elements(), walls, OccluderTree(walls), oracle, {}, cost), {});
    const auto n = static_cast<Eigen::Index>(space.functions());
    Eigen::ArrayXd uniform = Eigen::ArrayXd::Zero(n);
    for (const Element& element : space.elements())
        uniform[element.first] = std::sqrt(element.area());
    const auto response = [&](bool closed, double threshold) {
        Eigen::ArrayXd result = Eigen::ArrayXd::Zero(n);
        const SymmetricOperator kept =
            BounceTruncation(space, std::vector<bool>(6, closed), all, Eigen::ArrayXd::Ones(n))
                .at(threshold);
        if (threshold > 0) {
            EXPECT_LT(kept.coefficients(), all.size() / 2);
        }
        kept.apply(uniform, result);
        return result;
    };
    const double norm = uniform.matrix().norm();
    const Eigen::ArrayXd before = response(false, 0);
    EXPECT_GT((before - uniform).matrix().norm(), 1e-3 * norm) << "coarse links ripple";
    EXPECT_LT((response(true, 0) - uniform).matrix().norm(), 1e-6 * norm);
    EXPECT_LT((response(true, 1e-3) - uniform).matrix().norm(), 1e-3 * norm);
    EXPECT_LT((response(false, 1e-3) - before).matrix().norm(), 1e-3 * norm);
}

TEST(BounceTruncation, ForgettingChangesNothingAboveTheThreshold) {
    const std::vector<Quad> walls = testing::box_walls({3, 2, 2});
    const RadianceSpace space(testing::uniform_elements(walls, 2));
    const Visibility visibility(walls);
    const GeometricOracle oracle({}, walls, visibility, space.area());
    OracleCost cost;
    const auto all = direct_transport(
        space, refine_links(space.elements(), walls, OccluderTree(walls), oracle, {}, cost), {});
    const auto n = static_cast<Eigen::Index>(space.functions());
    BounceTruncation truncation(space, std::vector<bool>(6, true), all, Eigen::ArrayXd::Ones(n));
    const SymmetricOperator before = truncation.at(1e-3);
    truncation.forget_below(5e-4);
    const SymmetricOperator after = truncation.at(1e-3);
    EXPECT_LT(before.coefficients(), all.size());
    EXPECT_EQ(after.upper.row, before.upper.row);
    EXPECT_EQ(after.upper.value, before.upper.value);
    EXPECT_LT(truncation.at(0).coefficients(), all.size());
}

}  // namespace
}  // namespace lightwell
