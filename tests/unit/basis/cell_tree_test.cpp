#include "radiance4d/basis/cell_tree.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "tests/unit/basis/samples.h"

namespace lightwell {
namespace {

void expect_same(const ParameterRect& a, const ParameterRect& b) {
    EXPECT_EQ(a.u0, b.u0);
    EXPECT_EQ(a.u1, b.u1);
    EXPECT_EQ(a.v0, b.v0);
    EXPECT_EQ(a.v1, b.v1);
}

/// Child c of a rectangle: u counts first, then v.
ParameterRect child_of(const ParameterRect& r, Split split, std::uint32_t c) {
    const double u = 0.5 * (r.u0 + r.u1), v = 0.5 * (r.v0 + r.v1);
    const bool late_u = split == Split::v ? false : c % 2 == 1;
    const bool late_v = split == Split::v ? c == 1 : split == Split::both && c >= 2;
    ParameterRect part = r;
    if (split != Split::v) (late_u ? part.u0 : part.u1) = u;
    if (split != Split::u) (late_v ? part.v0 : part.v1) = v;
    return part;
}

TEST(CellTree, ChildrenCutTheirParentInHalvesOrQuarters) {
    for (const CellTree& tree : testing::sample_trees()) {
        for (int level = 0; level < tree.levels(); ++level) {
            const Split split = tree.splits()[static_cast<std::size_t>(level)];
            ASSERT_EQ(tree.children(level), split == Split::both ? 4U : 2U);
            ASSERT_EQ(tree.cells(level + 1), tree.cells(level) * tree.children(level));
            for (std::uint32_t m = 0; m < tree.cells(level); ++m) {
                const Cell cell{level, m};
                EXPECT_FALSE(tree.is_finest(cell));
                for (std::uint32_t c = 0; c < tree.children(level); ++c) {
                    const Cell child = tree.child(cell, c);
                    EXPECT_EQ(tree.parent(child), cell);
                    EXPECT_EQ(child.level, level + 1);
                    expect_same(tree.rect(child), child_of(tree.rect(cell), split, c));
                }
            }
        }
    }
}

TEST(CellTree, RootIsTheWholeSquare) {
    for (const CellTree& tree : testing::sample_trees())
        expect_same(tree.rect({}), {0, 1, 0, 1});
}

TEST(CellTree, FinestCellsFormTheGrid) {
    for (const CellTree& tree : testing::sample_trees()) {
        ASSERT_EQ(tree.columns() * tree.rows(), tree.functions());
        std::set<std::uint32_t> seen;
        for (std::uint32_t row = 0; row < tree.rows(); ++row) {
            for (std::uint32_t column = 0; column < tree.columns(); ++column) {
                const std::uint32_t m = tree.finest_at(column, row);
                EXPECT_EQ(
                    tree.finest_around((column + 0.9) / tree.columns(), (row + 0.1) / tree.rows()),
                    m);
                ASSERT_LT(m, tree.functions());
                EXPECT_TRUE(seen.insert(m).second);
                EXPECT_TRUE(tree.is_finest({tree.levels(), m}));
                const double wide = 1.0 / tree.columns(), high = 1.0 / tree.rows();
                expect_same(tree.rect({tree.levels(), m}),
                            {column * wide, (column + 1) * wide, row * high, (row + 1) * high});
            }
        }
    }
}

TEST(CellTree, PositionsNumberAllCellsCoarseToFine) {
    for (const CellTree& tree : testing::sample_trees()) {
        std::uint32_t next = 0;
        for (int level = 0; level <= tree.levels(); ++level) {
            for (std::uint32_t m = 0; m < tree.cells(level); ++m, ++next) {
                EXPECT_EQ(tree.position({level, m}), next);
                EXPECT_EQ(tree.at(next), (Cell{level, m}));
            }
        }
        EXPECT_EQ(tree.positions(), next);
    }
}

TEST(CellTree, EveryFunctionIsOneWaveletOrTheScalingFunction) {
    for (const CellTree& tree : testing::sample_trees()) {
        std::set<std::uint32_t> seen = {0};
        EXPECT_EQ(tree.support(0), Cell{});
        EXPECT_EQ(tree.level_of_function(0), 0);
        for (int level = 0; level < tree.levels(); ++level) {
            for (std::uint32_t m = 0; m < tree.cells(level); ++m) {
                for (std::uint32_t k = 1; k < tree.children(level); ++k) {
                    const std::uint32_t function = tree.wavelet({level, m}, k);
                    EXPECT_TRUE(seen.insert(function).second) << function;
                    EXPECT_EQ(tree.support(function), (Cell{level, m}));
                    EXPECT_EQ(tree.level_of_function(function), level);
                }
            }
        }
        EXPECT_EQ(seen.size(), tree.functions());
        EXPECT_EQ(*seen.rbegin() + 1, tree.functions());
    }
}

TEST(CellTree, CoarseFunctionsComeFirst) {
    const CellTree tree({Split::u, Split::both, Split::v});
    for (int depth = 0; depth < tree.levels(); ++depth)
        for (std::uint32_t f = 0; f < tree.functions(); ++f)
            EXPECT_EQ(f == 0 || tree.level_of_function(f) < depth,
                      f < std::max(1U, tree.cells(depth)));
}

/// Sides of the finest cells of a domain.
struct Sides {
    double u, v;
};

Sides finest_sides(const CellTree& tree, double extent_u, double extent_v) {
    return {extent_u / tree.columns(), extent_v / tree.rows()};
}

TEST(TreeForExtents, CellsAreSmallEnoughAndNoSmallerThanNeeded) {
    for (const double along : {0.3, 1.0, 1.3, 1.5, 2.0, 2.9, 7.0, 40.0}) {
        for (const double across : {0.05, 0.3, 1.0, 1.45, 6.0}) {
            const CellTree tree = tree_for_extents(along, across, 0.5, 30);
            const Sides finest = finest_sides(tree, along, across);
            EXPECT_LE(finest.u, 0.5);
            EXPECT_LE(finest.v, 0.5);
            if (tree.levels() == 0) continue;
            std::vector<Split> fewer = tree.splits();
            fewer.pop_back();
            const Sides before = finest_sides(CellTree(fewer), along, across);
            EXPECT_GT(std::max(before.u, before.v), 0.5) << along << " x " << across;
        }
    }
}

TEST(TreeForExtents, LongSidesAreHalvedAloneUntilCellsAreNearSquare) {
    for (const double along : {1.0, 1.4, 1.5, 3.0, 5.0, 11.0, 33.0}) {
        for (const bool turned : {false, true}) {
            const double u = turned ? 1.0 : along, v = turned ? along : 1.0;
            const CellTree tree = tree_for_extents(u, v, 0.05, 30);
            const Sides finest = finest_sides(tree, u, v);
            EXPECT_LE(std::max(finest.u / finest.v, finest.v / finest.u), std::sqrt(2.0) + 1e-12);
            bool squares = false;
            for (const Split split : tree.splits()) {
                if (split == Split::both)
                    squares = true;
                else {
                    EXPECT_FALSE(squares) << "one side alone after both";
                    EXPECT_EQ(split, turned ? Split::v : Split::u);
                }
            }
        }
    }
}

TEST(TreeForExtents, StopsAtTheLevelsAllowed) {
    EXPECT_EQ(tree_for_extents(100, 100, 0.1, 3).levels(), 3);
    EXPECT_EQ(tree_for_extents(100, 1, 0.1, 0).levels(), 0);
}

}  // namespace
}  // namespace lightwell
