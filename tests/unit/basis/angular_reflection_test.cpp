#include "radiance4d/basis/angular_reflection.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "radiance4d/basis/direction_map.h"
#include "radiance4d/failure.h"
#include "radiance4d/scene/brdf.h"

namespace lightwell {
namespace {

Lobe phong(double exponent) {
    return PhongLobe{Rgb::Ones(), exponent};
}

Lobe ggx(double roughness) {
    return GgxLobe{Rgb::Ones(), roughness};
}

/// Mean of a function of directions over a cell of the angular square, by n x n midpoints.
template <typename Function>
double mean_over(const HaarBasis& basis, const Cell& cell, int n, const Function& function) {
    const ParameterRect r = basis.tree().rect(cell);
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            sum += function(direction_from_square(
                {r.u0 + (i + .5) / n * (r.u1 - r.u0), r.v0 + (j + .5) / n * (r.v1 - r.v0)}));
    return sum / (n * n);
}

/// Means over the cells of what light with the given means becomes.
Eigen::ArrayXd reflected(const AngularReflection& reflection, const Eigen::ArrayXd& light) {
    const HaarBasis basis = angular_basis(reflection.level());
    const double root = std::sqrt(static_cast<double>(light.size()));
    RowMatrix field = light.matrix() / root;
    basis.analyse(field, reflection.level());
    RowMatrix result = reflection.matrix() * field;
    basis.synthesise(result, reflection.level());
    return result.col(0).array() * root;
}

class LobeInWavelets : public ::testing::TestWithParam<Lobe> {
  protected:
    const AngularReflection reflection{GetParam()};
    const HaarBasis basis = angular_basis(reflection.level());
};

TEST_P(LobeInWavelets, IsReciprocal) {
    const RowMatrix& matrix = reflection.matrix();
    ASSERT_EQ(matrix.rows(), static_cast<Eigen::Index>(basis.tree().functions()));
    EXPECT_LE((matrix - matrix.transpose()).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_P(LobeInWavelets, HasNoNormAboveItsAlbedo) {
    Material material;
    material.reflectance.setZero();
    material.lobe = GetParam();
    Eigen::VectorXd light = Eigen::VectorXd::Ones(reflection.matrix().rows());
    double norm = 0;
    for (int step = 0; step < 300; ++step) {
        light = reflection.matrix() * light.normalized();
        norm = light.norm();
    }
    EXPECT_LE(norm, albedo_peak(material).albedo + 1e-3);
    EXPECT_GT(norm, 0.3);
}

// The glossy furnace's condition: uniform light leaves as a(theta), so that emission of the rest
// makes it uniform again. And the flux: the mean albedo times what came in, within 0.2 %.
TEST_P(LobeInWavelets, ReflectsUniformLightByTheAlbedo) {
    const auto cells = basis.tree().functions();
    const Eigen::ArrayXd out = reflected(reflection, Eigen::ArrayXd::Ones(cells));
    const bool is_cheap = std::holds_alternative<PhongLobe>(GetParam());
    for (std::uint32_t m = 0; is_cheap && m < cells; m += 1 + cells / 6) {
        const double exact = mean_over(basis, {reflection.level(), m}, 48, [&](const Vec3& w) {
            return lobe_albedo(GetParam(), w[2]);
        });
        EXPECT_NEAR(out[m], exact, 0.002 * exact) << "cell " << m;
    }
    Material material;
    material.reflectance.setZero();
    material.lobe = GetParam();
    const double flux = mean_albedo(material)[0];
    EXPECT_NEAR(out.mean(), flux, 0.002 * flux);
    EXPECT_NEAR(reflection.matrix()(0, 0), out.mean(), 1e-9);
}

// Light from one cell: the lobe itself, averaged over cells. What the integration lacks must be
// small beside the tolerance of the representation: an eighth adds less than a hundredth to it.
TEST_P(LobeInWavelets, ReflectsLightFromOneCellByTheBrdf) {
    const auto cells = basis.tree().functions();
    const int level = reflection.level();
    const int points = std::min(24, 96 >> level);
    const std::uint32_t from = cells / 3;
    Eigen::ArrayXd light = Eigen::ArrayXd::Zero(cells);
    light[from] = 1;
    const Eigen::ArrayXd out = reflected(reflection, light);
    double squares = 0, off = 0;
    for (std::uint32_t m = 0; m < cells; ++m) {
        const double exact =
            mean_over(basis, {level, m}, 4,
                      [&](const Vec3& w) {
                          return mean_over(basis, {level, from}, points, [&](const Vec3& in) {
                              return M_PI * lobe_value(GetParam(), in, w);
                          });
                      }) /
            cells;
        squares += exact * exact;
        off += std::pow(out[m] - exact, 2);
    }
    EXPECT_LT(std::sqrt(off / squares), AngularResolution{}.tolerance / 8);
}

TEST_P(LobeInWavelets, MeetsTheToleranceAndNoCoarserLevelDoes) {
    const std::vector<double>& errors = reflection.error_by_level();
    ASSERT_EQ(errors.size(), static_cast<std::size_t>(reflection.level()) + 1);
    EXPECT_TRUE(reflection.follows());
    EXPECT_LE(reflection.error(), AngularResolution{}.tolerance);
    for (std::size_t level = 1; level < errors.size(); ++level) {
        EXPECT_LT(errors[level], errors[level - 1]);
        EXPECT_GT(errors[level - 1], AngularResolution{}.tolerance);
    }
}

INSTANTIATE_TEST_SUITE_P(Lobes, LobeInWavelets,
                         ::testing::Values(phong(1), phong(5), phong(30), ggx(0.5), ggx(0.3)));

// Each level halves the cells, and with them the error of piecewise constants.
TEST(AngularReflection, ConvergesByALevelAHalf) {
    const AngularReflection fine(phong(5), {1e-3, 4});
    EXPECT_FALSE(fine.follows());
    const std::vector<double>& errors = fine.error_by_level();
    ASSERT_EQ(errors.size(), 5u);
    for (std::size_t level = 3; level < 5; ++level) {
        EXPECT_GT(errors[level - 1] / errors[level], 1.6);
        EXPECT_LT(errors[level - 1] / errors[level], 2.3);
    }
}

TEST(AngularReflection, SharperLobesNeedMoreLevels) {
    int last = 0;
    for (const double exponent : {1.0, 5.0, 20.0, 50.0}) {
        const int level = AngularReflection(phong(exponent)).level();
        EXPECT_GE(level, last) << exponent;
        last = level;
    }
    EXPECT_EQ(last, 4);
}

TEST(AngularReflection, SaysWhenNoLevelFollows) {
    const AngularReflection mirror(phong(1000), {0.4, 3});
    EXPECT_FALSE(mirror.follows());
    EXPECT_EQ(mirror.level(), 3);
    EXPECT_GT(mirror.error(), 0.8);
}

// So rough that its light hardly depends on direction.
TEST(AngularReflection, OfRoughFacetsNeedsNoDirections) {
    Material material;
    material.reflectance.setZero();
    material.lobe = ggx(1);
    const AngularReflection rough(material.lobe);
    EXPECT_EQ(rough.level(), 0);
    EXPECT_NEAR(rough.matrix()(0, 0), mean_albedo(material)[0], 0.002 * rough.matrix()(0, 0));
}

// However little that changes the light of others: an eye sees the difference.
TEST(AngularReflection, HasTheLevelsThatItShallHaveAtLeast) {
    AngularResolution two;
    two.tolerance = 0.9;
    two.least_levels = 2;
    EXPECT_EQ(AngularReflection(ggx(1), two).level(), 2);
    EXPECT_EQ(AngularReflection(phong(1), two).level(), 2);
    EXPECT_EQ(AngularReflection(Lobe(NoLobe{}), two).level(), 0);
}

// What shares a lobe's levels gets the matrices themselves, whoever asked first.
TEST(LobeLevels, AreComputedOnceForAll) {
    const LobeLevels levels(phong(20));
    const LobeLevels copy = levels;
    std::array<const RowMatrix*, 8> seen{};
    tbb::parallel_for(std::size_t{0}, seen.size(),
                      [&](std::size_t k) { seen[k] = &(k % 2 == 0 ? levels : copy).matrix(3); });
    for (const RowMatrix* one : seen)
        EXPECT_EQ(one, seen[0]);
    const AngularReflection chosen(copy, {0.05, 4}), given = AngularReflection::at_level(copy, 3);
    EXPECT_EQ(&given.matrix(), seen[0]);
    EXPECT_EQ(chosen.error(), levels.error(chosen.level()));
    const AngularReflection alone(phong(20), {0.05, 4});
    EXPECT_EQ(alone.level(), chosen.level());
    EXPECT_EQ(alone.matrix(), chosen.matrix());
}

TEST(LobeLevels, GoFromNoneToFive) {
    const LobeLevels none{NoLobe{}};
    EXPECT_EQ(none.matrix(1), RowMatrix::Zero(4, 4));
    EXPECT_EQ(none.error(1), 0);
    EXPECT_THROW(none.matrix(-1), BrokenInvariant);
    EXPECT_THROW(none.matrix(6), BrokenInvariant);
}

TEST(AngularReflection, OfNoLobeReflectsNothing) {
    const AngularReflection none{Lobe(NoLobe{})};
    EXPECT_EQ(none.level(), 0);
    EXPECT_TRUE(none.follows());
    EXPECT_EQ(none.matrix()(0, 0), 0);
}

}  // namespace
}  // namespace lightwell
