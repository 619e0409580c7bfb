#include "radiance4d/basis/direction_map.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/unit/basis/samples.h"

namespace lightwell {
namespace {

TEST(DirectionMap, EverySquarePointComesBack) {
    testing::Numbers numbers(4);
    for (int k = 0; k < 20000; ++k) {
        const Vec2 st(numbers.between(0, 1), numbers.between(0, 1));
        const Vec3 direction = direction_from_square(st);
        EXPECT_NEAR(direction.norm(), 1, 1e-15);
        EXPECT_GE(direction[2], 0);
        EXPECT_LT((square_from_direction(direction) - st).norm(), 1e-14);
    }
}

TEST(DirectionMap, EveryDirectionComesBack) {
    testing::Numbers numbers(5);
    for (int k = 0; k < 20000; ++k) {
        Vec3 direction = numbers.vector(-1, 1);
        if (direction.norm() < 0.1) continue;
        direction.normalize();
        direction[2] = std::abs(direction[2]);
        const Vec2 st = square_from_direction(direction);
        EXPECT_GE(st.minCoeff(), 0);
        EXPECT_LE(st.maxCoeff(), 1);
        // Near the horizon the height is lost in the disk's rounding: sqrt(1e-16).
        EXPECT_LT((direction_from_square(st) - direction).norm(), 1e-7);
        EXPECT_LT((direction_from_square(st) - direction).head<2>().norm(), 1e-14);
    }
}

TEST(DirectionMap, PlacesThatAreKnown) {
    EXPECT_LT((direction_from_square({0.5, 0.5}) - Vec3(0, 0, 1)).norm(), 1e-15);
    EXPECT_LT((direction_from_square({1, 0.5}) - Vec3(1, 0, 0)).norm(), 1e-15);
    EXPECT_LT((direction_from_square({0.5, 1}) - Vec3(0, 1, 0)).norm(), 1e-15);
    const double diagonal = std::sqrt(0.5);
    EXPECT_LT((direction_from_square({1, 1}) - Vec3(diagonal, diagonal, 0)).norm(), 1e-7);
    EXPECT_LT((direction_from_square({0, 0}) - Vec3(-diagonal, -diagonal, 0)).norm(), 1e-7);
    EXPECT_LT((square_from_direction({0, 0, 1}) - Vec2(0.5, 0.5)).norm(), 1e-15);
}

// ds dt = cos(theta) dw / pi says that the map onto the disk multiplies areas by pi everywhere.
TEST(DirectionMap, DiskAreasArePiTimesSquareAreas) {
    testing::Numbers numbers(6);
    constexpr double h = 1e-6;
    for (int k = 0; k < 5000; ++k) {
        const Vec2 st(numbers.between(0.001, 0.999), numbers.between(0.001, 0.999));
        // The map has creases along the diagonals, where it is continuous but has no derivative.
        if (std::abs(std::abs(st[0] - 0.5) - std::abs(st[1] - 0.5)) < 1e-4) continue;
        const Vec3 in_s =
            direction_from_square(st + Vec2(h, 0)) - direction_from_square(st - Vec2(h, 0));
        const Vec3 in_t =
            direction_from_square(st + Vec2(0, h)) - direction_from_square(st - Vec2(0, h));
        const double area = (in_s[0] * in_t[1] - in_s[1] * in_t[0]) / (4 * h * h);
        EXPECT_NEAR(area, M_PI, 1e-6);
    }
}

// Moments over the square are moments over the hemisphere weighted by cos(theta)/pi.
TEST(DirectionMap, MomentsAreCosineWeighted) {
    constexpr int n = 400;
    std::array<double, 5> cosine{};
    Vec3 mean = Vec3::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const Vec3 d = direction_from_square({(i + 0.5) / n, (j + 0.5) / n});
            for (std::size_t p = 0; p < cosine.size(); ++p)
                cosine[p] += std::pow(d[2], static_cast<double>(p)) / (n * n);
            mean += d / (n * n);
            second += d * d.transpose() / (n * n);
        }
    }
    // Int cos^p cos dw / pi = 2 / (p + 2). The square root at the horizon costs the midpoint rule
    // half an order.
    for (std::size_t p = 0; p < cosine.size(); ++p)
        EXPECT_NEAR(cosine[p], 2.0 / (static_cast<double>(p) + 2), p % 2 == 1 ? 1e-4 : 1e-5);
    EXPECT_LT((mean - Vec3(0, 0, 2.0 / 3)).norm(), 1e-4);
    EXPECT_LT((second - Eigen::Matrix3d(Vec3(0.25, 0.25, 0.5).asDiagonal())).norm(), 1e-5);
}

TEST(LocalFrame, IsRightHandedAboutTheNormal) {
    const Quad quad = testing::trapezoid();
    for (const Quad& side : {quad, quad.reversed()}) {
        const Eigen::Matrix3d frame = local_frame(side);
        EXPECT_LT((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm(), 1e-15);
        EXPECT_NEAR(frame.determinant(), 1, 1e-15);
        EXPECT_LT((frame.col(2) - side.normal()).norm(), 1e-15);
        EXPECT_GT(frame.col(0).dot(side.point(1, 0.5) - side.point(0, 0.5)), 0);
    }
}

}  // namespace
}  // namespace lightwell
