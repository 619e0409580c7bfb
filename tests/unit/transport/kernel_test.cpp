#include "solver/transport/kernel.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/shared_reference.h"
#include "tests/unit/basis/samples.h"

namespace lightwell {
namespace {

using testing::Numbers;

Facet facet_of(const Quad& quad) {
    return Facet::of(quad, quad.normal());
}

/// [x0,x1] x [y0,y1] at a height, facing up or down.
Facet level(double x0, double x1, double y0, double y1, double z, bool up) {
    const Quad quad{{Vec3(x0, y0, z), Vec3(x1, y0, z), Vec3(x1, y1, z), Vec3(x0, y1, z)}};
    return facet_of(up ? quad : quad.reversed());
}

/// [x0,x1] x [z0,z1] in the plane y = 0, facing +y.
Facet upright(double x0, double x1, double z0, double z1) {
    return facet_of(Quad{{Vec3(x0, 0, z0), Vec3(x0, 0, z1), Vec3(x1, 0, z1), Vec3(x1, 0, z0)}});
}

/// A number, or a sum or difference in words as the reference writes them, is always a number here.
std::array<double, 4> rectangle(const nlohmann::json& r) {
    return {r[0].get<double>(), r[1].get<double>(), r[2].get<double>(), r[3].get<double>()};
}

TEST(ExchangeArea, IsTheKnownViewFactor) {
    LIGHTWELL_SHARED_JSON(known, "reference/viewfactors.json");
    int compared = 0;
    for (const nlohmann::json& entry : known.at("entries")) {
        const auto a = rectangle(entry.at("rect1")), b = rectangle(entry.at("rect2"));
        const auto distance = entry.at("distance").get<double>();
        const Facet x = level(a[0], a[1], a[2], a[3], 0, true);
        const Facet y = entry.at("kind") == "par" ? level(b[0], b[1], b[2], b[3], distance, false)
                                                  : upright(b[0], b[1], b[2], b[3]);
        const double wanted = x.area() * entry.at("F12_double").get<double>();
        // Squares a hundred sides apart are integrated by points.
        const double tolerance = distance > 50 ? 1e-6 : 1e-9;
        EXPECT_NEAR(exchange_area(x, y), wanted, tolerance * wanted) << entry.at("name");
        EXPECT_NEAR(exchange_area(y, x), wanted, tolerance * wanted) << entry.at("name");
        ++compared;
    }
    EXPECT_GE(compared, 20);
}

TEST(ExchangeArea, IsTheKnownWedgeFactor) {
    LIGHTWELL_SHARED_JSON(known, "reference/viewfactors.json");
    for (const nlohmann::json& wedge : known.at("wedge_C16")) {
        const auto a = wedge.at("A").get<double>(), b = wedge.at("B").get<double>();
        const double angle = wedge.at("phi_deg").get<double>() * M_PI / 180;
        const Facet floor = level(0, 1, 0, b, 0, true);
        const Vec3 up(0, a * std::cos(angle), a * std::sin(angle));
        const Facet wall = facet_of(Quad{{Vec3(0, 0, 0), up, up + Vec3(1, 0, 0), Vec3(1, 0, 0)}});
        const double wanted = b * wedge.at("F").get<double>();
        const double longest = std::max({a, b, a / b, b / a});
        EXPECT_NEAR(exchange_area(floor, wall), wanted, (longest > 15 ? 2e-5 : 1e-6) * wanted)
            << "A " << a << " B " << b << " angle " << wedge.at("phi_deg");
    }
}

TEST(ExchangeArea, OppositeSquaresHaveTheClosedForm) {
    // Hottel: parallel unit squares at distance h, x = 1/h.
    for (const double h : {0.05, 0.3, 1.0, 2.0, 7.0}) {
        const double x = 1 / h, s = std::sqrt(1 + x * x);
        const double f = 2 / (M_PI * x * x) *
                         (0.5 * std::log((1 + x * x) * (1 + x * x) / (1 + 2 * x * x)) +
                          2 * x * s * std::atan(x / s) - 2 * x * std::atan(x));
        EXPECT_NEAR(exchange_area(level(0, 1, 0, 1, 0, true), level(0, 1, 0, 1, h, false)), f,
                    1e-9 * f);
    }
}

/// Two convex quads that share the edge from (0,0,0) to (1,0,0) at an angle, neither of them a
/// rectangle.
std::pair<Quad, Quad> skew_wedge(double angle, Numbers& numbers) {
    const Vec3 away(0, std::cos(angle), std::sin(angle)), along(1, 0, 0), flat(0, 1, 0);
    const auto far_end = [&](double where, const Vec3& way) -> Vec3 {
        return (where + numbers.between(-0.3, 0.3)) * along + numbers.between(0.4, 1.5) * way;
    };
    const Quad floor{{Vec3::Zero(), along, far_end(1, flat), far_end(0, flat)}};
    const Quad wall{{Vec3::Zero(), far_end(0, away), far_end(1, away), along}};
    return {floor, wall};
}

TEST(ExchangeArea, TouchingSkewPolygonsAddUp) {
    Numbers numbers(40);
    for (int k = 0; k < 30; ++k) {
        const auto [x, y] = skew_wedge(numbers.between(0.4, 2.9), numbers);
        const double whole = exchange_area(facet_of(x), facet_of(y));
        double parts = 0;
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b < 4; ++b) {
                const auto quarter = [](const Quad& q, int c) {
                    return q.part(0.5 * (c % 2), 0.5 * (c % 2) + 0.5, c < 2 ? 0 : 0.5,
                                  c < 2 ? 0.5 : 1);
                };
                parts += exchange_area(facet_of(quarter(x, a)), facet_of(quarter(y, b)));
            }
        EXPECT_NEAR(parts, whole, 1e-6 * whole) << k;
    }
}

TEST(ExchangeArea, IsSymmetric) {
    Numbers numbers(41);
    for (int k = 0; k < 30; ++k) {
        const auto [x, y] = skew_wedge(numbers.between(0.4, 2.9), numbers);
        const double forth = exchange_area(facet_of(x), facet_of(y));
        EXPECT_NEAR(exchange_area(facet_of(y), facet_of(x)), forth, 1e-6 * forth);
    }
}

/// A random quad near a place, facing about a direction.
Quad quad_at(const Vec3& place, const Vec3& facing, Numbers& numbers) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), facing + 0.5 * numbers.vector(-1, 1));
    Quad quad;
    const std::array<Vec3, 4> corner = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0),
                                        Vec3(-1, 1, 0)};
    for (std::size_t c = 0; c < 4; ++c)
        quad.vertex[c] = place + turn * Vec3(corner[c][0] * numbers.between(0.5, 1),
                                             corner[c][1] * numbers.between(0.5, 1), 0);
    return quad;
}

TEST(ExchangeArea, ScalesAsAnArea) {
    Numbers numbers(42);
    for (int k = 0; k < 20; ++k) {
        const auto [x, y] = k % 2 == 0
                                ? skew_wedge(1.2, numbers)
                                : std::pair{quad_at({0, 0, 0}, {0, 0, 1}, numbers),
                                            quad_at({0, 0, k * 2.0 + 3}, {0, 0, -1}, numbers)};
        const double unit = exchange_area(facet_of(x), facet_of(y));
        for (const double scale : {1e-3, 0.1, 1e3}) {
            const auto scaled = [scale](Quad quad) {
                for (Vec3& v : quad.vertex)
                    v *= scale;
                return facet_of(quad);
            };
            EXPECT_NEAR(exchange_area(scaled(x), scaled(y)) / (scale * scale), unit, 1e-9 * unit);
        }
    }
}

/// Int Int F dA dA by a product midpoint rule with one step of Richardson's extrapolation.
double slow_exchange(const Quad& x, const Quad& y) {
    const auto rule = [&](int n) {
        double sum = 0;
        for (int a = 0; a < n * n; ++a)
            for (int b = 0; b < n * n; ++b) {
                const double u = (a % n + 0.5) / n, v = (a / n + 0.5) / n;
                const double s = (b % n + 0.5) / n, t = (b / n + 0.5) / n;
                sum += kernel(x.point(u, v), x.normal(), y.point(s, t), y.normal()) *
                       x.jacobian(u, v) * y.jacobian(s, t) / (n * n * n * n);
            }
        return sum;
    };
    return (4 * rule(24) - rule(12)) / 3;
}

TEST(ExchangeArea, IsTheIntegralOfTheKernel) {
    Numbers numbers(43);
    for (const double distance : {3.0, 5.0, 8.0, 12.0, 30.0}) {
        const Quad x = quad_at({0, 0, 0}, {0, 0, 1}, numbers);
        const Quad y = quad_at({0.5, -0.2, distance}, {0, 0, -1}, numbers);
        const double slow = slow_exchange(x, y);
        EXPECT_NEAR(exchange_area(facet_of(x), facet_of(y)), slow, 2e-6 * slow) << distance;
    }
}

TEST(ExchangeArea, BothRulesAgreeWhereTheyMeet) {
    Numbers numbers(44);
    for (int k = 0; k < 50; ++k) {
        const Facet x = facet_of(quad_at({0, 0, 0}, {0, 0, 1}, numbers));
        const Facet y = facet_of(quad_at({0, 0, numbers.between(20, 40)}, {0, 0, -1}, numbers));
        const double points = exchange_area_by_points(x, y);
        EXPECT_NEAR(exchange_area_by_contour(x, y), points, 5e-6 * points);
    }
}

TEST(Kernel, IsSymmetricAndDarkBehind) {
    Numbers numbers(45);
    for (int k = 0; k < 200; ++k) {
        const Vec3 x = numbers.vector(-1, 1), y = numbers.vector(-1, 1);
        const Vec3 n = numbers.vector(-1, 1).normalized(), m = numbers.vector(-1, 1).normalized();
        const double f = kernel(x, n, y, m);
        EXPECT_NEAR(kernel(y, m, x, n), f, 1e-12 * f);
        const Vec3 way = y - x;
        const bool faces = way.dot(n) > 0 && way.dot(m) < 0;
        EXPECT_EQ(f > 0, faces);
        if (!faces) continue;
        const double r = way.norm();
        EXPECT_NEAR(f, way.dot(n) / r * -way.dot(m) / r / (M_PI * r * r), 1e-12 * f);
    }
}

TEST(Facet, PartsInFrontAndBehindMakeTheWhole) {
    Numbers numbers(46);
    int cut = 0;
    for (int k = 0; k < 500; ++k) {
        const Quad quad = quad_at(numbers.vector(-1, 1), numbers.vector(-1, 1), numbers);
        const Facet whole = facet_of(quad);
        const Vec3 n = numbers.vector(-1, 1).normalized();
        const double d = numbers.between(-0.5, 0.5);
        const Facet front = whole.in_front_of(n, d, 1e-12), back = whole.in_front_of(-n, -d, 1e-12);
        EXPECT_NEAR(whole.area(), quad.area(), 1e-13);
        EXPECT_NEAR(front.area() + back.area(), whole.area(), 1e-11);
        for (const Vec3& vertex : front) {
            EXPECT_GE(n.dot(vertex) - d, -1e-12);
            EXPECT_NEAR(quad.normal().dot(vertex - quad.vertex[0]), 0, 1e-12);
        }
        if (!front.empty()) {
            EXPECT_TRUE(front.normal == whole.normal);
        }
        if (!front.empty() && !back.empty()) ++cut;
    }
    EXPECT_GT(cut, 100);
}

TEST(Facet, NothingRemainsOfWhatLiesInThePlane) {
    const Facet facet = level(0, 1, 0, 1, 2, true);
    EXPECT_TRUE(facet.in_front_of(Vec3::UnitZ(), 2, 1e-9).empty());
    EXPECT_TRUE(facet.in_front_of(-Vec3::UnitZ(), -2, 1e-9).empty());
    EXPECT_TRUE(facet.in_front_of(Vec3::UnitZ(), 3, 1e-9).empty());
    EXPECT_NEAR(facet.in_front_of(Vec3::UnitZ(), 1, 1e-9).area(), 1, 1e-15);
    EXPECT_NEAR(facet.in_front_of(Vec3::UnitX(), 0.25, 1e-9).area(), 0.75, 1e-15);
}

TEST(Facet, CanBeCutAgainAndAgain) {
    Facet facet = level(-1, 1, -1, 1, 0, true);
    for (const double angle : {0.7, 2.3, 3.9, 5.5})
        facet = facet.in_front_of({std::cos(angle), std::sin(angle), 0}, -1.2, 1e-12);
    EXPECT_EQ(facet.size(), 8);
    EXPECT_LT(facet.area(), 4);
    EXPECT_GT(facet.area(), 3.5);
}

}  // namespace
}  // namespace lightwell
