#include "radiance4d/scene/convex_polygon.h"

#include <random>

#include <gtest/gtest.h>

#include "tests/unit/radiance4d/rooms.h"

namespace lightwell {
namespace {

const Quad unit_square = level_rectangle(0, 1, 0, 1, 0);

TEST(ConvexPolygon, MeasuresASquare) {
    const ConvexPolygon square(unit_square);
    EXPECT_EQ(square.size(), 4);
    EXPECT_DOUBLE_EQ(square.area(), 1);
    EXPECT_DOUBLE_EQ(square.extent(), std::sqrt(2.0));
    EXPECT_LT((square.vector_area() - Vec3::UnitZ()).norm(), 1e-15);
    EXPECT_LT((square.reversed().vector_area() + Vec3::UnitZ()).norm(), 1e-15);
    EXPECT_LT((square.moved(Vec3(1, 2, 3)).centre() - Vec3(1.5, 2.5, 3)).norm(), 1e-15);
    EXPECT_DOUBLE_EQ(square.moved(Vec3(1, 2, 3)).reach(), std::sqrt(0.5));
    EXPECT_EQ(ConvexPolygon().area(), 0);
}

TEST(ConvexPolygon, APlaneKeepsItsInside) {
    const ConvexPolygon square(unit_square);
    const ConvexPolygon right = clipped(square, Plane{Vec3::UnitX(), 0.75});
    EXPECT_EQ(right.size(), 4);
    EXPECT_DOUBLE_EQ(right.area(), 0.25);
    for (const Vec3& vertex : right)
        EXPECT_GE(vertex[0], 0.75);
    const CutPolygon corner = cut(square, Plane{Vec3(1, 1, 0).normalized(), 1.5 / std::sqrt(2.0)});
    EXPECT_EQ(corner.inside.size(), 3);
    EXPECT_EQ(corner.outside.size(), 5);
    EXPECT_NEAR(corner.inside.area(), 0.125, 1e-15);
    EXPECT_NEAR(corner.outside.area(), 0.875, 1e-15);
}

TEST(ConvexPolygon, SliversAndTouchingPlanesLeaveThePolygonWhole) {
    for (const double scale : {1e-6, 1.0, 1e6}) {
        const ConvexPolygon square(level_rectangle(0, scale, 0, scale, 0));
        const CutPolygon above = cut(square, Plane{Vec3::UnitX(), -1e-15 * scale});
        EXPECT_EQ(above.inside.size(), 4);
        EXPECT_TRUE(above.outside.empty());
        const CutPolygon sliver = cut(square, Plane{Vec3::UnitX(), (1 - 1e-15) * scale});
        EXPECT_TRUE(sliver.inside.empty());
        EXPECT_EQ(sliver.outside.size(), 4);
        const CutPolygon thin = cut(square, Plane{Vec3::UnitX(), (1 - 1e-9) * scale});
        EXPECT_NEAR(thin.inside.area(), 1e-9 * scale * scale, 1e-15 * scale * scale);
        ConvexPolygon needle;
        needle.append(Vec3::Zero());
        needle.append(scale * Vec3(1, 0, 0));
        needle.append(scale * Vec3(1, 1e-15, 0));
        EXPECT_TRUE(clipped(needle, Plane{Vec3::UnitX(), 0.5 * scale}).empty());
        const CutPolygon in_plane = cut(square, Plane{Vec3::UnitZ(), 0});
        EXPECT_TRUE(in_plane.inside.empty());
        EXPECT_EQ(in_plane.outside.size(), 4);
    }
}

TEST(ConvexPolygon, RandomCutsKeepTheArea) {
    std::mt19937 random(3);
    for (int k = 0; k < 2000; ++k) {
        ConvexPolygon rest(placed(unit_square, some_turn(), random_point(random)));
        double vanished = 0;
        for (int c = 0; c < 8 && !rest.empty(); ++c) {
            const Vec3 n = random_direction(random);
            const CutPolygon parts = cut(rest, Plane{n, n.dot(random_point(random))});
            const Vec3 sum = parts.inside.vector_area() + parts.outside.vector_area();
            ASSERT_LT((sum - rest.vector_area()).norm(), 1e-14);
            const bool keep_inside = parts.inside.area() > parts.outside.area();
            vanished += keep_inside ? parts.outside.area() : parts.inside.area();
            rest = keep_inside ? parts.inside : parts.outside;
        }
        ASSERT_NEAR(rest.area() + vanished, 1, 1e-13);
    }
}

TEST(ConvexPolygon, HalvesMakeTheWhole) {
    ConvexPolygon round;
    for (int i = 0; i < ConvexPolygon::capacity; ++i)
        round.append(Vec3(std::cos(i * M_PI / 8), std::sin(i * M_PI / 8), 0));
    const auto [first, second] = halved(round);
    EXPECT_EQ(first.size(), 9);
    EXPECT_EQ(second.size(), 9);
    EXPECT_NEAR(first.area() + second.area(), round.area(), 1e-15);
    EXPECT_THROW(round.append(Vec3::Zero()), BrokenInvariant);
    EXPECT_THROW(clipped(round, Plane{Vec3::UnitX(), -0.99}), BrokenInvariant);
}

}  // namespace
}  // namespace lightwell
