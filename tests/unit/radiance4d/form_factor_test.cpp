#include "radiance4d/scene/form_factor.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/shared_reference.h"
#include "tests/unit/radiance4d/rooms.h"

namespace lightwell {
namespace {

/// Point to a parallel rectangle with a corner straight above it (Siegel and Howell, B-4).
double corner_above(double a, double b, double height) {
    const double x = a / height, y = b / height;
    const double p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
    return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * M_PI);
}

/// Point on a floor to a wall rectangle that starts at the floor, `distance` away, with one lower
/// corner straight ahead (Siegel and Howell, B-5).
double corner_ahead(double width, double height, double distance) {
    const double slant = std::hypot(distance, height);
    return (std::atan(width / distance) - distance / slant * std::atan(width / slant)) / (2 * M_PI);
}

/// Gauss-Legendre rule on [0,1] by Newton's method on the Legendre polynomial.
std::vector<std::pair<double, double>> gauss(int n) {
    std::vector<std::pair<double, double>> rule;
    for (int i = 0; i < n; ++i) {
        double z = std::cos(M_PI * (i + 0.75) / (n + 0.5)), slope = 1;
        for (int step = 0; step < 100; ++step) {
            double p = 1, before = 0;
            for (int k = 0; k < n; ++k) {
                const double next = ((2 * k + 1) * z * p - k * before) / (k + 1);
                before = p;
                p = next;
            }
            slope = n * (z * p - before) / (z * z - 1);
            z -= p / slope;
        }
        rule.emplace_back(0.5 * (1 + z), 1 / ((1 - z * z) * slope * slope));
    }
    return rule;
}

/// Two rectangles' factor by integrating the point factor over the first.
double integrated(const Quad& receiver, const Quad& sender, int order) {
    const auto rule = gauss(order);
    const Vec3 n = receiver.normal();
    double sum = 0;
    for (const auto& [u, weight_u] : rule)
        for (const auto& [v, weight_v] : rule)
            sum += weight_u * weight_v *
                   point_form_factor(receiver.point(u, v), n, ConvexPolygon(sender));
    return sum;
}

class AtScale : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Scales, AtScale, ::testing::Values(1e-3, 1.0, 1e3));

TEST_P(AtScale, PointToRectangleMatchesClosedForms) {
    const double s = GetParam();
    for (const double a : {1e-3, 0.3, 1.0, 20.0})
        for (const double b : {1e-3, 0.5, 7.0})
            for (const double h : {1e-9, 1e-6, 1e-3, 0.1, 1.0, 100.0}) {
                const Quad ceiling = level_rectangle(0, s * a, 0, s * b, s * h).reversed();
                EXPECT_NEAR(point_form_factor(Vec3::Zero(), Vec3::UnitZ(), ConvexPolygon(ceiling)),
                            corner_above(a, b, h), 1e-13);
                const Quad wall{{Vec3(0, s * h, 0), Vec3(s * a, s * h, 0),
                                 Vec3(s * a, s * h, s * b), Vec3(0, s * h, s * b)}};
                EXPECT_NEAR(point_form_factor(Vec3::Zero(), Vec3::UnitZ(), ConvexPolygon(wall)),
                            corner_ahead(a, b, h), 1e-13);
            }
}

TEST_P(AtScale, WallsOfABoxCloseTo1AndTo4Pi) {
    const double s = GetParam();
    std::mt19937 random(5);
    for (const bool turned : {false, true}) {
        const Eigen::Matrix3d turn = turned ? some_turn() : Eigen::Matrix3d::Identity();
        std::vector<Quad> walls = box_walls(Vec3::Zero(), s * Vec3(4, 5, 3));
        for (Quad& wall : walls)
            wall = placed(wall, turn, Vec3::Zero());
        for (int k = 0; k < 3000; ++k) {
            Vec3 local = random_point(random).cwiseProduct(Vec3(4, 5, 3));
            // Some close to a wall, an edge or a corner.
            for (int axis = 0; axis < 3; ++axis)
                if (k % 3 == axis || k % 7 == axis) local[axis] = std::pow(10, -1 - k % 4);
            const Vec3 x = s * (turn * local);
            const Vec3 n = random_direction(random);
            double factors = 0, angles = 0;
            for (const Quad& wall : walls) {
                factors += point_form_factor(x, n, ConvexPolygon(wall));
                angles += signed_solid_angle(x, ConvexPolygon(wall));
            }
            ASSERT_NEAR(factors, 1, 1e-12) << local.transpose();
            ASSERT_NEAR(angles, 4 * M_PI, 4 * M_PI * 1e-12) << local.transpose();
        }
    }
}

TEST_P(AtScale, OnAWallTheOtherFiveClose) {
    const double s = GetParam();
    const std::vector<Quad> walls = box_walls(Vec3::Zero(), s * Vec3(4, 5, 3));
    for (const double u : {1e-12, 1e-6, 0.1, 0.5})
        for (const double v : {1e-12, 1e-6, 0.1, 0.5, 1 - 1e-6})
            for (std::size_t i = 0; i < 6; ++i) {
                double sum = 0;
                // Rounding must not put x outside of the box.
                const Vec3 x =
                    walls[i].point(u, v).cwiseMin(s * Vec3(4, 5, 3)).cwiseMax(Vec3::Zero());
                for (const Quad& wall : walls)
                    sum += point_form_factor(x, walls[i].normal(), ConvexPolygon(wall));
                EXPECT_NEAR(sum, 1, 1e-12) << "wall " << i << " at " << u << ", " << v;
            }
}

TEST(FormFactor, MatchesTheReferenceTable) {
    LIGHTWELL_SHARED_JSON(table, "reference/viewfactors.json");
    int compared = 0;
    for (const auto& entry : table["entries"]) {
        const auto& a = entry["rect1"];
        const auto& b = entry["rect2"];
        const double distance = entry["distance"];
        const Quad first = level_rectangle(a[0], a[1], a[2], a[3], 0);
        // "par": both level, `distance` apart. "perp": the second stands on the line y = 0.
        Quad second;
        if (entry["kind"] == "par") {
            second = level_rectangle(b[0], b[1], b[2], b[3], distance).reversed();
        } else {
            const double x0 = b[0], x1 = b[1], z0 = b[2], z1 = b[3];
            second = {{Vec3(x0, 0, z0), Vec3(x0, 0, z1), Vec3(x1, 0, z1), Vec3(x1, 0, z0)}};
        }
        // Touching and nearly touching rectangles have a bounded but not smooth integrand.
        const bool touching = distance < 0.1 && b[2] == 0 && a[2] == 0;
        const double expected = entry["F12_double"];
        EXPECT_NEAR(integrated(first, second, touching ? 200 : 60), expected,
                    touching ? 1e-4 * expected : 1e-13)
            << entry["name"];
        ++compared;
    }
    EXPECT_GE(compared, 20);
}

TEST(FormFactor, OnlyTheFrontCounts) {
    const ConvexPolygon floor(level_rectangle(-1, 1, -1, 1, 0));
    EXPECT_GT(point_form_factor(Vec3(0, 0, 1), -Vec3::UnitZ(), floor), 0.5);
    EXPECT_EQ(point_form_factor(Vec3(0, 0, 1), Vec3::UnitZ(), floor), 0);
    EXPECT_EQ(point_form_factor(Vec3(0, 0, -1), Vec3::UnitZ(), floor), 0);
    EXPECT_GT(point_form_factor(Vec3(0, 0, -1), Vec3::UnitZ(), floor.reversed()), 0.5);
    EXPECT_EQ(point_form_factor(Vec3(0, 0, 0), Vec3::UnitZ(), floor), 0);
    EXPECT_EQ(point_form_factor(Vec3(3, 0, 0), Vec3::UnitX(), floor), 0);
    EXPECT_EQ(point_form_factor(Vec3(0, 0, 1), Vec3::UnitZ(), ConvexPolygon()), 0);
}

TEST(FormFactor, TheHorizonCutsWhatLiesBelow) {
    // A wall of endless extent, seen by a level element: half its hemisphere.
    const double far = 1e9;
    const ConvexPolygon wall(
        Quad{{Vec3(-far, 1, -far), Vec3(far, 1, -far), Vec3(far, 1, far), Vec3(-far, 1, far)}});
    EXPECT_NEAR(point_form_factor(Vec3::Zero(), Vec3::UnitZ(), wall), 0.5, 1e-8);
    EXPECT_NEAR(point_form_factor(Vec3::Zero(), Vec3::UnitY(), wall), 1, 1e-8);
}

TEST(FormFactor, IsFiniteOnEdgesAndCorners) {
    const ConvexPolygon wall(Quad{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 1), Vec3(0, 0, 1)}});
    EXPECT_EQ(point_form_factor(Vec3(0.5, 0, 0), Vec3::UnitZ(), wall), 0);
    EXPECT_EQ(point_form_factor(Vec3(0, 0, 0), Vec3::UnitZ(), wall), 0);
    EXPECT_NEAR(point_form_factor(Vec3(0.5, -1e-13, 0), Vec3::UnitZ(), wall), 0.5, 1e-12);
    EXPECT_EQ(solid_angle(Vec3(0, 0, 0), wall), 0);
    EXPECT_EQ(solid_angle(Vec3(0.3, 0, 0.7), wall), 0);
}

TEST(SolidAngle, MatchesThePyramid) {
    // Seen from above its centre: 4 asin(ab / sqrt((a^2+h^2)(b^2+h^2))), half sides a and b.
    for (const double a : {1e-6, 0.1, 1.0, 1e3})
        for (const double b : {1e-6, 0.5, 1e3})
            for (const double h : {1e-3, 1.0, 50.0}) {
                const ConvexPolygon level(level_rectangle(-a, a, -b, b, 0));
                const double expected = 4 * std::atan2(a * b, h * std::sqrt(a * a + b * b + h * h));
                EXPECT_NEAR(signed_solid_angle(Vec3(0, 0, h), level), expected, 1e-14 * expected);
                EXPECT_NEAR(signed_solid_angle(Vec3(0, 0, -h), level), -expected, 1e-14 * expected);
            }
}

TEST(SolidAngle, ASquareAtCloseRangeFillsHalfTheSphere) {
    const ConvexPolygon level(level_rectangle(-1, 1, -2, 2, 0));
    for (const double h : {1e-3, 1e-9, 1e-15})
        EXPECT_NEAR(solid_angle(Vec3(0.3, 0.6, h), level), 2 * M_PI, 10 * h + 1e-14);
}

}  // namespace
}  // namespace lightwell
