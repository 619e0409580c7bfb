#include "solver/transport/direct_transport.h"

#include <cmath>

#include <gtest/gtest.h>

#include "solver/series/bounce_truncation.h"
#include "solver/transport/geometric_oracle.h"
#include "solver/transport/refiner.h"
#include "solver/transport/variation_oracle.h"
#include "tests/unit/basis/samples.h"
#include "tests/unit/transport/box.h"

namespace lightwell {
namespace {

/// Two trapezoids over each other, one of them partly buried.
RadianceSpace two_sides() {
    Element below, above;
    below.quad = 0;
    below.geometry = testing::trapezoid();
    below.set_space(CellTree({Split::u, Split::both}),
                    {all_open, 0xFFFF, all_open, all_open, all_open, 0, all_open, all_open});
    above.quad = 1;
    above.geometry = testing::trapezoid().reversed();
    for (Vec3& v : above.geometry.vertex)
        v += Vec3(0, 0, 1);
    above.set_space(CellTree({Split::both, Split::both}), {});
    return RadianceSpace({below, above});
}

/// Links of several levels that part the pair, with made-up exchange areas.
PairLinks mixed_links(const RadianceSpace& space) {
    const CellTree& x = space.element(0).space.tree();
    const CellTree& y = space.element(1).space.tree();
    testing::Numbers numbers(70);
    PairLinks pair{0, 1, {}};
    const auto add = [&](const Cell& receiver, const Cell& sender) {
        pair.links.push_back(
            {x.position(receiver), y.position(sender), numbers.between(0.01, 0.1), false});
    };
    add({1, 0}, {0, 0});
    for (std::uint32_t child = 0; child < 4; ++child) {
        const Cell receiver = x.child({1, 1}, child);
        for (std::uint32_t m = 0; m < 4; ++m) {
            if (m != 2) add(receiver, {1, m});
            for (std::uint32_t c = 0; m == 2 && c < 4; ++c)
                add(receiver, y.child({1, m}, c));
        }
    }
    return pair;
}

/// <b_r, M b_s> by the slow double loop: over every pair of functions, every pair of finest cells,
/// and every link that holds both.
Eigen::MatrixXd slow_operator(const RadianceSpace& space, const PairLinks& pair) {
    const HaarBasis& x = space.element(pair.receiver).space;
    const HaarBasis& y = space.element(pair.sender).space;
    const Eigen::MatrixXd bx = testing::explicit_basis(x), by = testing::explicit_basis(y);
    const auto is_within = [](const CellTree& tree, std::uint32_t finest, const Cell& cell) {
        Cell at{tree.levels(), finest};
        while (at.level > cell.level)
            at = tree.parent(at);
        return at == cell;
    };
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(bx.rows(), by.rows());
    for (Eigen::Index r = 0; r < bx.rows(); ++r)
        for (Eigen::Index s = 0; s < by.rows(); ++s)
            for (std::uint32_t m = 0; m < x.tree().functions(); ++m)
                for (std::uint32_t n = 0; n < y.tree().functions(); ++n)
                    for (const LinkValue& link : pair.links) {
                        const Cell cx = x.tree().at(link.receiver), cy = y.tree().at(link.sender);
                        if (!is_within(x.tree(), m, cx) || !is_within(y.tree(), n, cy)) continue;
                        const double density = link.exchange / (x.area(cx) * y.area(cy));
                        const double over_m = bx(r, m) * std::sqrt(x.area({x.tree().levels(), m}));
                        const double over_n = by(s, n) * std::sqrt(y.area({y.tree().levels(), n}));
                        result(r, s) += density * over_m * over_n;
                    }
    return result;
}

TEST(DirectTransport, IsTheSlowDoubleLoopOverFunctions) {
    const RadianceSpace space = two_sides();
    const PairLinks pair = mixed_links(space);
    const Eigen::MatrixXd slow = slow_operator(space, pair);
    Eigen::MatrixXd fast = Eigen::MatrixXd::Zero(slow.rows(), slow.cols());
    const std::uint32_t second = space.element(1).first;
    for (const Coefficient& c : direct_transport(space, {pair}, {})) {
        ASSERT_LT(c.row, second);
        ASSERT_GE(c.column, second);
        EXPECT_EQ(fast(c.row, c.column - second), 0) << "twice the same";
        fast(c.row, c.column - second) = static_cast<double>(c.value);
    }
    EXPECT_LT((fast - slow).cwiseAbs().maxCoeff(), 1e-6 * slow.cwiseAbs().maxCoeff())
        << "floats hold the coefficients";
}

TEST(DirectTransport, IsOrderedByColumnThenRow) {
    const std::vector<Quad> walls = testing::box_walls({3, 2, 2});
    const RadianceSpace space(testing::uniform_elements(walls, 2));
    const Visibility visibility(walls);
    const GeometricOracle oracle({}, walls, visibility, space.area());
    OracleCost cost;
    const auto coefficients = direct_transport(
        space, refine_links(space.elements(), walls, OccluderTree(walls), oracle, {}, cost), {});
    ASSERT_GT(coefficients.size(), 1000U);
    for (std::size_t k = 1; k < coefficients.size(); ++k) {
        const Coefficient &a = coefficients[k - 1], &b = coefficients[k];
        EXPECT_TRUE(a.column < b.column || (a.column == b.column && a.row < b.row));
        EXPECT_LT(b.row, b.column);
    }
}

/// The operator between two unit squares that face each other openly, as a dense matrix.
Eigen::MatrixXd two_squares(const Oracle& oracle, const std::vector<Quad>& quads) {
    const RadianceSpace space(testing::uniform_elements(quads, 2));
    OracleCost cost;
    const auto links = refine_links(space.elements(), quads, OccluderTree(quads), oracle, {}, cost);
    const Eigen::ArrayXd ones = Eigen::ArrayXd::Ones(static_cast<Eigen::Index>(space.functions()));
    const BounceTruncation all(space, {false, false}, direct_transport(space, links, {}), ones);
    return Eigen::MatrixXd(to_matrix(all.at(0), ones));
}

TEST(Oracles, AgreeWhereNothingStandsBetween) {
    std::vector<Quad> quads = {testing::unit_square(), testing::unit_square().reversed()};
    for (Vec3& v : quads[1].vertex)
        v += Vec3(0.2, 0, 1);
    const Visibility visibility(quads);
    GeometricOracleOptions exact;
    exact.tolerance = 0;
    const Eigen::MatrixXd geometric =
        two_squares(GeometricOracle(exact, quads, visibility, 2), quads);
    VariationOracleOptions fine;
    fine.sender_threshold = fine.receiver_threshold = 1e-3;
    fine.samples = 64;
    const Eigen::MatrixXd variation = two_squares(VariationOracle(fine, visibility), quads);
    EXPECT_NEAR(variation(0, 16), geometric(0, 16), 1e-3 * geometric(0, 16));
    EXPECT_LT((variation - geometric).norm(), 0.02 * geometric.norm());
}

}  // namespace
}  // namespace lightwell
