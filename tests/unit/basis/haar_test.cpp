#include "radiance4d/basis/haar.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/basis/samples.h"

namespace lightwell {
namespace {

using testing::explicit_basis;
using testing::Numbers;

/// Bases on a square, on a trapezoid, and on a trapezoid of which cells are partly buried.
std::vector<HaarBasis> sample_bases() {
    std::vector<HaarBasis> bases;
    Numbers numbers(7);
    for (const CellTree& tree : testing::sample_trees()) {
        bases.emplace_back(testing::unit_square(), tree);
        bases.emplace_back(testing::trapezoid(), tree);
        std::vector<double> open;
        for (std::uint32_t m = 0; m < tree.functions(); ++m)
            open.push_back(m % 3 == 0 ? 1.0 : m % 3 == 1 ? 1e-3 : numbers.between(0.02, 1));
        bases.emplace_back(testing::trapezoid(), tree, open);
    }
    return bases;
}

TEST(HaarBasis, AreasAreThoseOfTheQuadTimesTheOpenShare) {
    const CellTree tree({Split::u, Split::both});
    const Quad quad = testing::trapezoid();
    std::vector<double> open(tree.functions(), 1.0);
    open[3] = 0.25;
    const HaarBasis whole(quad, tree), partly(quad, tree, open);
    EXPECT_NEAR(whole.area({}), quad.area(), 1e-14);
    for (std::uint32_t m = 0; m < tree.functions(); ++m) {
        const ParameterRect r = tree.rect({2, m});
        // The integral of a bilinear map's Jacobian, which is linear in each parameter.
        const double area =
            quad.jacobian(0.5 * (r.u0 + r.u1), 0.5 * (r.v0 + r.v1)) * (r.u1 - r.u0) * (r.v1 - r.v0);
        EXPECT_NEAR(whole.area({2, m}), area, 1e-14);
        EXPECT_NEAR(partly.area({2, m}), area * open[m], 1e-14);
    }
    EXPECT_NEAR(partly.area({}), quad.area() - 0.75 * whole.area({2, 3}), 1e-14);
}

TEST(HaarBasis, FunctionsAreOrthonormal) {
    for (const HaarBasis& basis : sample_bases()) {
        const Eigen::MatrixXd b = explicit_basis(basis);
        EXPECT_LT((b * b.transpose() - Eigen::MatrixXd::Identity(b.rows(), b.cols()))
                      .cwiseAbs()
                      .maxCoeff(),
                  1e-13);
    }
}

TEST(HaarBasis, TransformsAreThoseOfTheExplicitBasis) {
    Numbers numbers(1);
    for (const HaarBasis& basis : sample_bases()) {
        const Eigen::MatrixXd b = explicit_basis(basis);
        const RowMatrix cells = numbers.matrix(b.rows(), 3);
        RowMatrix rows = cells;
        basis.analyse(rows, basis.tree().levels());
        EXPECT_LT((rows - b * cells).cwiseAbs().maxCoeff(), 1e-14 * static_cast<double>(b.rows()));
        RowMatrix back = cells;
        basis.synthesise(back, basis.tree().levels());
        EXPECT_LT((back - b.transpose() * cells).cwiseAbs().maxCoeff(),
                  1e-14 * static_cast<double>(b.rows()));
    }
}

TEST(HaarBasis, SynthesisUndoesAnalysisAtEveryDepth) {
    Numbers numbers(2);
    for (const HaarBasis& basis : sample_bases()) {
        for (int depth = 0; depth <= basis.tree().levels(); ++depth) {
            const RowMatrix cells = numbers.matrix(basis.tree().cells(depth), 5);
            RowMatrix rows = cells;
            basis.analyse(rows, depth);
            EXPECT_NEAR(rows.squaredNorm(), cells.squaredNorm(), 1e-13 * cells.squaredNorm())
                << "Parseval";
            basis.synthesise(rows, depth);
            EXPECT_LT((rows - cells).cwiseAbs().maxCoeff(), 1e-14);
        }
    }
}

// What the direct transport operator rests on: a block sampled at a coarse depth has the same
// coefficients as its copy on finer cells.
TEST(HaarBasis, CoarseAnalysisIsTheStartOfTheFineOne) {
    Numbers numbers(3);
    for (const HaarBasis& basis : sample_bases()) {
        const CellTree& tree = basis.tree();
        for (int depth = 0; depth < tree.levels(); ++depth) {
            RowMatrix coarse = numbers.matrix(tree.cells(depth), 2);
            RowMatrix fine(tree.functions(), 2);
            const std::uint32_t each = tree.functions() / tree.cells(depth);
            for (std::uint32_t m = 0; m < tree.functions(); ++m)
                fine.row(m) = coarse.row(m / each) * std::sqrt(basis.area({tree.levels(), m}) /
                                                               basis.area({depth, m / each}));
            basis.analyse(coarse, depth);
            basis.analyse(fine, tree.levels());
            EXPECT_LT((fine.topRows(coarse.rows()) - coarse).cwiseAbs().maxCoeff(), 1e-14);
            EXPECT_LT(fine.bottomRows(fine.rows() - coarse.rows()).cwiseAbs().maxCoeff(), 1e-14);
        }
    }
}

TEST(HaarBasis, ConstantRadianceIsTheScalingFunctionAlone) {
    for (const HaarBasis& basis : sample_bases()) {
        const CellTree& tree = basis.tree();
        RowMatrix rows(tree.functions(), 1);
        for (std::uint32_t m = 0; m < tree.functions(); ++m)
            rows(m, 0) = 3 * std::sqrt(basis.area({tree.levels(), m}));
        basis.analyse(rows, tree.levels());
        EXPECT_NEAR(rows(0, 0), 3 * std::sqrt(basis.area({})), 1e-13);
        EXPECT_LT(rows.bottomRows(rows.rows() - 1).cwiseAbs().sum(), 1e-13);
    }
}

TEST(HaarBasis, EqualAreasGiveTheClassicalHaarWavelets) {
    const HaarBasis square(testing::unit_square(), CellTree({Split::both}));
    Eigen::Matrix4d classical;
    classical << 1, 1, 1, 1,  //
        1, -1, 1, -1,         // along u
        1, 1, -1, -1,         // along v
        1, -1, -1, 1;         // both
    EXPECT_LT((square.frame({}) - classical / 2).cwiseAbs().maxCoeff(), 1e-15);
    for (const Split split : {Split::u, Split::v}) {
        const HaarBasis halves(testing::unit_square(), CellTree({split}));
        Eigen::Matrix2d haar;
        haar << 1, 1, 1, -1;
        EXPECT_LT(
            (halves.frame({}).topLeftCorner<2, 2>() - haar * std::sqrt(0.5)).cwiseAbs().maxCoeff(),
            1e-15);
    }
}

TEST(HaarBasis, RefusesTheWrongNumberOfRows) {
    const HaarBasis basis(testing::unit_square(), CellTree({Split::both}));
    RowMatrix rows = RowMatrix::Zero(3, 1);
    EXPECT_ANY_THROW(basis.analyse(rows, 1));
    EXPECT_ANY_THROW(basis.synthesise(rows, 1));
}

}  // namespace
}  // namespace lightwell
