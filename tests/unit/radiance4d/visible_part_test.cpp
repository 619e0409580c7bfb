#include "radiance4d/scene/visible_part.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "radiance4d/scene/form_factor.h"
#include "radiance4d/scene/visibility.h"
#include "tests/shared_reference.h"
#include "tests/unit/radiance4d/rooms.h"

namespace lightwell {
namespace {

double total_area(const std::vector<ConvexPolygon>& pieces) {
    double sum = 0;
    for (const ConvexPolygon& piece : pieces)
        sum += piece.area();
    return sum;
}

/// Whether a point in a piece's plane lies inside it.
bool holds(const ConvexPolygon& piece, const Vec3& point) {
    const Vec3 area = piece.vector_area();
    for (int i = 0; i < piece.size(); ++i)
        if (area.dot((piece.after(i) - piece[i]).cross(point - piece[i])) < 0) return false;
    return true;
}

TEST(VisiblePart, PointLightBehindABlockerMatchesTheReference) {
    LIGHTWELL_SHARED_JSON(cases, "reference/direct_tests.json");
    const auto& test = cases["point_light_hard_shadow"];
    const Vec3 light(test["light"][0], test["light"][1], test["light"][2]);
    const auto& b = test["blocker_x1x2y1y2z"];
    const std::vector<Quad> quads{level_rectangle(b[0], b[1], b[2], b[3], b[4])};
    const Quad floor =
        level_rectangle(test["floor"][0], test["floor"][1], test["floor"][2], test["floor"][3], 0);
    const double intensity = test["I"];
    int levels = 0;
    for (const auto& [level, means] : test["levels"].items()) {
        const std::size_t n = means.size();
        const double step = 1.0 / static_cast<double>(n);
        for (std::size_t row = 0; row < n; ++row)
            for (std::size_t column = 0; column < n; ++column) {
                // Rows run along x, columns along y: (tb, tc) = (x, y) on a floor.
                const Quad patch = floor.part(
                    static_cast<double>(row) * step, static_cast<double>(row + 1) * step,
                    static_cast<double>(column) * step, static_cast<double>(column + 1) * step);
                double flux = 0;
                for (const ConvexPolygon& piece :
                     visible_part(light, ConvexPolygon(patch), quads, {0}))
                    flux += intensity * solid_angle(light, piece);
                const double expected = means[row][column];
                EXPECT_NEAR(flux / patch.area(), expected, 1e-6 * std::max(expected, 1.0))
                    << "level " << level << " row " << row << " column " << column;
            }
        ++levels;
    }
    EXPECT_GE(levels, 5);
}

TEST(VisiblePart, PenumbraOfASquareLampMatchesTheReference) {
    LIGHTWELL_SHARED_JSON(cases, "reference/direct_tests.json");
    const auto& profile = cases["area_light_penumbra"]["profile_y0"];
    ASSERT_EQ(profile.size(), 121U);
    const ConvexPolygon lamp(level_rectangle(-0.5, 0.5, -0.5, 0.5, 3).reversed());
    const std::vector<Quad> quads{level_rectangle(-0.3, 0.7, -0.5, 0.5, 1.5)};
    for (const auto& point : profile) {
        const Vec3 x(point[0], 0, 0);
        double factor = 0;
        for (const ConvexPolygon& piece : visible_part(x, lamp, quads, {0}))
            factor += point_form_factor(x, Vec3::UnitZ(), piece);
        const double open = point[1], shadowed = point[2];
        EXPECT_NEAR(M_PI * 1000 * factor, shadowed, 1e-6 * open) << x[0];
        EXPECT_NEAR(M_PI * 1000 * point_form_factor(x, Vec3::UnitZ(), lamp), open, 1e-6 * open);
    }
}

class VisiblePartAtScale : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Scales, VisiblePartAtScale, ::testing::Values(1e-3, 1.0, 1e3));

// Pieces never overlap, and hold exactly the points that a ray from x reaches.
TEST_P(VisiblePartAtScale, RandomScenesAgreeWithRays) {
    const double scale = GetParam();
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(0, 1);
    int partial = 0, wrong = 0, compared = 0;
    for (int scene = 0; scene < 60; ++scene) {
        std::vector<Quad> quads;
        std::vector<int> others;
        for (int q = 0; q < 12; ++q) {
            const Quad quad = random_parallelogram(random, 0.7);
            quads.push_back(
                placed(quad, scale * Eigen::Matrix3d::Identity(), scale * Vec3(3, -2, 1)));
            if (q > 0) others.push_back(q);
        }
        const Visibility visibility(quads);
        const Quad& target = quads[0];
        for (int view = 0; view < 5; ++view) {
            const Vec3 x = scale * (Vec3(3, -2, 1) + random_point(random));
            const auto pieces = visible_part(x, ConvexPolygon(target), quads, others);
            const double share = total_area(pieces) / target.area();
            if (share > 0.01 && share < 0.99) ++partial;
            for (int ray = 0; ray < 50; ++ray) {
                const Vec3 y = target.point(uniform(random), uniform(random));
                int holders = 0;
                for (const ConvexPolygon& piece : pieces)
                    holders += holds(piece, y) ? 1 : 0;
                ASSERT_LE(holders, 1);
                wrong += (holders == 1) == visibility.occluded(x, free_point, y, 0) ? 1 : 0;
                ++compared;
            }
        }
    }
    EXPECT_GT(partial, 60);
    // Rays are single precision: a few in ten thousand pass an edge within its rounding.
    EXPECT_LE(wrong, compared / 5000);
}

TEST_P(VisiblePartAtScale, AWallOfManyQuadsHidesAll) {
    const double s = GetParam();
    // Cut at uneven places, with T-vertices, and turned so that nothing is exact.
    for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(100, -70, 30)}) {
        const Quad wall = level_rectangle(-2 * s, 2 * s, -2 * s, 2 * s, s);
        std::vector<Quad> quads;
        std::vector<int> all;
        const std::vector<double> u{0, 0.13, 0.37, 0.61, 0.9, 1};
        for (std::size_t i = 0; i + 1 < u.size(); ++i)
            for (int j = 0; j < 3 + static_cast<int>(i); ++j) {
                const double rows = 3 + static_cast<double>(i);
                all.push_back(static_cast<int>(quads.size()));
                quads.push_back(placed(wall.part(u[i], u[i + 1], j / rows, (j + 1) / rows),
                                       some_turn(), s * shift));
            }
        const Quad target = placed(level_rectangle(-s, s, -s, s, 2 * s), some_turn(), s * shift);
        const Vec3 x = some_turn() * (s * Vec3(0.1, 0.2, 0.3)) + s * shift;
        const auto pieces = visible_part(x, ConvexPolygon(target), quads, all);
        EXPECT_LT(total_area(pieces), 1e-9 * s * s) << pieces.size() << " pieces left";
        const std::vector<int> all_but_one(all.begin() + 1, all.end());
        EXPECT_NO_THROW(visible_part(x, ConvexPolygon(target), quads, all_but_one));
    }
}

TEST(VisiblePart, OnlyWhatStandsBetweenHides) {
    const Vec3 x(0, 0, 0);
    const ConvexPolygon target(level_rectangle(-1, 1, -1, 1, 2).reversed());
    const auto seen_past = [&](const Quad& quad) {
        return total_area(visible_part(x, target, {quad}, {0}));
    };
    EXPECT_NEAR(seen_past(level_rectangle(-0.25, 0.25, -0.25, 0.25, 1)), 3, 1e-14);
    EXPECT_EQ(seen_past(level_rectangle(-5, 5, -5, 5, 1)), 0);
    EXPECT_EQ(seen_past(level_rectangle(-5, 5, -5, 5, 2)), 4);
    EXPECT_EQ(seen_past(level_rectangle(-5, 5, -5, 5, 2 + 1e-9)), 4);
    EXPECT_EQ(seen_past(level_rectangle(-5, 5, -5, 5, 2 - 1e-9)), 4);
    EXPECT_EQ(seen_past(level_rectangle(-5, 5, -5, 5, 2 - 1e-3)), 0);
    EXPECT_EQ(seen_past(level_rectangle(-5, 5, -5, 5, 3)), 4);
    EXPECT_EQ(seen_past(level_rectangle(-5, 5, -5, 5, 0)), 4);
    EXPECT_EQ(seen_past(level_rectangle(-5, 5, -5, 5, -1)), 4);
    // Half a wall that goes through x and the target's plane.
    EXPECT_EQ(seen_past(Quad{{Vec3(0, -5, -5), Vec3(0, 5, -5), Vec3(0, 5, 5), Vec3(0, -5, 5)}}), 4);
    // One that pierces the target: it hides what is beyond it from x.
    EXPECT_NEAR(
        seen_past(Quad{{Vec3(0.5, -5, -5), Vec3(0.5, 5, -5), Vec3(0.5, 5, 5), Vec3(0.5, -5, 5)}}),
        3, 1e-14);
    // From the target's own plane nothing is seen.
    EXPECT_TRUE(visible_part(Vec3(5, 0, 2), target, {}, {}).empty());
}

TEST(VisiblePart, CullingLeavesOutWhatIsBehindOrBeside) {
    const Vec3 x(0, 0, 0);
    // Aslant, so that no side of the pyramid's bounding box decides.
    const ConvexPolygon target(Quad{{Vec3(1, 1, 3), Vec3(3, 1, 1), Vec3(3, 3, 1), Vec3(1, 3, 3)}});
    const auto small_at = [](double px, double py, double pz) {
        const double h = 0.05;
        return level_rectangle(px - h, px + h, py - h, py + h, pz);
    };
    EXPECT_TRUE(may_occlude(x, target, small_at(1, 1, 1)));
    EXPECT_FALSE(may_occlude(x, target, small_at(2.5, 2.5, 2.5)));  // behind
    EXPECT_FALSE(may_occlude(x, target, small_at(0.3, 2.5, 1)));    // beside
    EXPECT_FALSE(may_occlude(x, target, small_at(-1, -1, -1)));     // at the back of x
}

TEST(VisiblePart, OneShadowHidesAllExactlyWhereNothingIsLeft) {
    std::mt19937 random(19);
    int hidden = 0;
    for (int k = 0; k < 20000; ++k) {
        const Vec3 x = random_point(random);
        const ConvexPolygon target(random_parallelogram(random, 0.2));
        const Quad quad = random_parallelogram(random, 0.8);
        const bool hides = hides_all(Shadow(x, quad), target);
        ASSERT_EQ(hides, visible_part(x, target, {quad}, {0}).empty()) << k;
        hidden += hides ? 1 : 0;
    }
    EXPECT_GT(hidden, 500);
}

TEST(VisiblePart, WhatLiesInTheBlockersPlaneIsNotHidden) {
    const Quad ceiling = level_rectangle(-2, 2, -2, 2, 3).reversed();
    const Shadow shadow(Vec3(0.1, 0.2, 1), ceiling);
    EXPECT_FALSE(hides_all(shadow, ConvexPolygon(level_rectangle(-1, 1, -1, 1, 3).reversed())));
    EXPECT_TRUE(hides_all(shadow, ConvexPolygon(level_rectangle(-1, 1, -1, 1, 3.001).reversed())));
}

TEST(VisiblePart, CullingIsConservativeAndUseful) {
    std::mt19937 random(17);
    int kept = 0, hiding = 0;
    for (int k = 0; k < 20000; ++k) {
        const Vec3 x = random_point(random);
        const ConvexPolygon target(random_parallelogram(random, 0.3));
        const Quad quad = random_parallelogram(random, 0.5);
        const bool may = may_occlude(x, target, quad);
        const bool does =
            total_area(visible_part(x, target, {quad}, {0})) < (1 - 1e-9) * target.area();
        ASSERT_TRUE(may || !does);
        kept += may ? 1 : 0;
        hiding += does ? 1 : 0;
    }
    EXPECT_GT(hiding, 1000);
    EXPECT_LT(kept, 2 * hiding);
}

}  // namespace
}  // namespace lightwell
