#include "radiance4d/basis/smooth_surface.h"

#include <array>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "tests/unit/basis/samples.h"

namespace lightwell {
namespace {

using Means = Eigen::Array<double, Eigen::Dynamic, 3>;
using Function = std::function<double(double, double)>;

CellTree square_tree(int levels) {
    return CellTree(std::vector<Split>(static_cast<std::size_t>(levels), Split::both));
}

/// Mean over a rectangle by Gauss: exact for polynomials of degree five in each parameter.
template <typename Value>
Value mean_over(const ParameterRect& r, const std::function<Value(double, double)>& f) {
    const double node = std::sqrt(0.15);
    const std::array<double, 3> at = {0.5 - node, 0.5, 0.5 + node};
    const std::array<double, 3> weight = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    Value sum = 0 * f(r.u0, r.v0);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            sum += weight[i] * weight[j] *
                   f(r.u0 + at[i] * (r.u1 - r.u0), r.v0 + at[j] * (r.v1 - r.v0));
    return sum;
}

/// Means of f, 2 f and 3 f.
Means means_of(const CellTree& tree, const Function& f) {
    Means means(tree.functions(), 3);
    for (std::uint32_t m = 0; m < tree.functions(); ++m)
        means.row(m) = mean_over<double>(tree.rect({tree.levels(), m}), f) *
                       Eigen::RowVector3d(1, 2, 3).array();
    return means;
}

Means random_means(const CellTree& tree, double low, double high, unsigned seed) {
    return testing::Numbers(seed).matrix(tree.functions(), 3, low, high).array();
}

TEST(SmoothSurface, KeepsTheMeanOfEveryCell) {
    for (const CellTree& tree : testing::sample_trees()) {
        const Means means = random_means(tree, 10, 11, 8);
        const SmoothSurface surface(tree, means);
        for (std::uint32_t m = 0; m < tree.functions(); ++m) {
            const Rgb mean = mean_over<Rgb>(tree.rect({tree.levels(), m}),
                                            [&](double u, double v) { return surface.at(u, v); });
            EXPECT_LT((mean - means.row(m).transpose()).abs().maxCoeff(), 1e-12);
        }
    }
}

TEST(SmoothSurface, ConstantsStayConstantOnEveryTree) {
    for (const CellTree& tree : testing::sample_trees()) {
        const SmoothSurface surface(tree, Means::Constant(tree.functions(), 3, 4));
        for (const double u : {0.0, 0.3, 0.5, 1.0})
            EXPECT_LT((surface.at(u, 1 - u) - 4).abs().maxCoeff(), 1e-14);
    }
}

void expect_exact(const CellTree& tree, const Function& f) {
    const SmoothSurface surface(tree, means_of(tree, f));
    for (int i = 0; i <= 20; ++i)
        for (int j = 0; j <= 20; ++j)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(surface.at(i / 20.0, j / 20.0)[c], (c + 1) * f(i / 20.0, j / 20.0),
                            1e-12);
}

TEST(SmoothSurface, LinearFunctionsAreExactToTheRim) {
    const Function plane = [](double u, double v) { return 3 + 2 * u - v; };
    for (const int levels : {1, 2, 3, 4})
        expect_exact(square_tree(levels), plane);
    expect_exact(CellTree({Split::u, Split::u, Split::both}), plane);
}

TEST(SmoothSurface, MonotoneQuadraticsAreExactToTheRim) {
    const Function bowl = [](double u, double v) {
        return (1 + u + 0.4 * u * u) * (5 - 2 * v - 0.5 * v * v);
    };
    for (const int levels : {2, 3, 4})
        expect_exact(square_tree(levels), bowl);
}

TEST(SmoothSurface, ErrorFallsWithTheThirdPowerInside) {
    const Function f = [](double u, double v) { return std::exp(1.5 * u - v); };
    double previous = 0;
    for (const int levels : {3, 4, 5, 6}) {
        const CellTree tree = square_tree(levels);
        const SmoothSurface surface(tree, means_of(tree, f));
        double worst = 0;
        for (int i = 0; i <= 97; ++i)
            for (int j = 0; j <= 97; ++j) {
                const double u = 0.25 + 0.5 * i / 97, v = 0.25 + 0.5 * j / 97;
                worst = std::max(worst, std::abs(surface.at(u, v)[0] - f(u, v)));
            }
        if (previous > 0) {
            EXPECT_GT(std::log2(previous / worst), 2.8) << "at level " << levels;
        }
        previous = worst;
    }
}

TEST(SmoothSurface, NoNewExtremumBetweenCells) {
    // A step, a spike and noise: where two cells meet along u at their middles, the value lies
    // between their means as reconstruction along v leaves them.
    const CellTree row({Split::u, Split::u, Split::u, Split::u});
    std::vector<Means> cases = {random_means(row, 0, 1, 9), random_means(row, 0, 100, 10)};
    cases.push_back(Means::Zero(16, 3));
    cases.back().bottomRows(8) = 1;
    cases.push_back(Means::Constant(16, 3, 1));
    cases.back().row(5) = 50;
    for (const Means& means : cases) {
        const SmoothSurface surface(row, means);
        for (std::uint32_t i = 1; i < 16; ++i) {
            const Rgb at = surface.at(i / 16.0, 0.5);
            const Rgb a = means.row(i - 1).transpose(), b = means.row(i).transpose();
            EXPECT_TRUE((at >= a.min(b) - 1e-12).all() && (at <= a.max(b) + 1e-12).all()) << i;
        }
    }
}

TEST(SmoothSurface, FlatPartsBesideAStepStayFlat) {
    const CellTree row({Split::u, Split::u, Split::u, Split::u});
    Means means = Means::Zero(16, 3);
    means.bottomRows(8) = 1;
    const SmoothSurface surface(row, means);
    for (int k = 0; k <= 160; ++k) {
        const double u = k / 160.0;
        if (u > 7.0 / 16 && u < 9.0 / 16) continue;
        EXPECT_NEAR(surface.at(u, 0.3)[0], u < 0.5 ? 0 : 1, 1e-13) << u;
    }
}

// The parabola in the one cell beside a step rings by at most a sixth of it.
TEST(SmoothSurface, AStepRingsByNoMoreThanASixth) {
    const CellTree row({Split::u, Split::u, Split::u, Split::u});
    Means means = Means::Constant(16, 3, 1);
    means.bottomRows(8) = 2;
    const SmoothSurface surface(row, means);
    for (int k = 0; k <= 1600; ++k) {
        const double value = surface.at(k / 1600.0, 0.5)[0];
        EXPECT_GE(value, 1 - 1.0 / 6 - 1e-12);
        EXPECT_LE(value, 2 + 1.0 / 6 + 1e-12);
    }
}

TEST(SmoothSurface, IsNeverNegative) {
    for (const unsigned seed : {11U, 12U, 13U}) {
        const CellTree tree = square_tree(3);
        Means means = random_means(tree, -1, 1, seed).max(0.0);
        const SmoothSurface surface(tree, means);
        double lowest = 1;
        for (int i = 0; i <= 200; ++i)
            for (int j = 0; j <= 200; ++j)
                lowest = std::min(lowest, surface.at(i / 200.0, j / 200.0).minCoeff());
        EXPECT_GE(lowest, 0);
    }
}

TEST(SmoothSurface, IsContinuousAcrossCells) {
    constexpr double h = 1e-9;
    for (const CellTree& tree : testing::sample_trees()) {
        const SmoothSurface surface(tree, random_means(tree, 0, 1, 14));
        for (std::uint32_t i = 1; i < tree.columns(); ++i)
            for (int k = 0; k <= 30; ++k) {
                const double u = static_cast<double>(i) / tree.columns(), v = k / 30.0;
                EXPECT_LT((surface.at(u - h, v) - surface.at(u + h, v)).abs().maxCoeff(), 1e-6);
            }
        for (std::uint32_t j = 1; j < tree.rows(); ++j)
            for (int k = 0; k <= 30; ++k) {
                const double v = static_cast<double>(j) / tree.rows(), u = k / 30.0;
                EXPECT_LT((surface.at(u, v - h) - surface.at(u, v + h)).abs().maxCoeff(), 1e-6);
            }
    }
}

TEST(SmoothSurface, PointsOutsideAreTakenToTheRim) {
    const CellTree tree = square_tree(2);
    const SmoothSurface surface(tree, random_means(tree, 1, 2, 15));
    EXPECT_TRUE((surface.at(-0.5, 0.4) == surface.at(0, 0.4)).all());
    EXPECT_TRUE((surface.at(0.4, 1.5) == surface.at(0.4, 1)).all());
}

}  // namespace
}  // namespace lightwell
