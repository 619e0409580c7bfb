// What a shaft is certain of, against rays.
#include "solver/transport/shaft.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/unit/basis/samples.h"
#include "tests/unit/radiance4d/rooms.h"

namespace lightwell {
namespace {

using testing::Numbers;

Quad random_quad(const Vec3& place, double size, Numbers& numbers) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), numbers.vector(-1, 1).normalized());
    const std::array<Vec3, 4> corner = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0),
                                        Vec3(-1, 1, 0)};
    Quad quad;
    for (std::size_t c = 0; c < 4; ++c)
        quad.vertex[c] = place + turn * (numbers.between(0.3, 1) * size * corner[c]);
    return quad;
}

Vec3 random_point(const Facet& facet, Numbers& numbers) {
    Vec3 sum = Vec3::Zero();
    double weights = 0;
    for (const Vec3& vertex : facet) {
        const double weight = std::pow(numbers.between(0, 1), 3);
        sum += weight * vertex;
        weights += weight;
    }
    return sum / weights;
}

/// How deep inside the quad the segment passes, as a share of the quad's size: negative where it
/// misses, near zero where it grazes an edge.
double depth_of(const Vec3& from, const Vec3& to, const Quad& quad) {
    const Vec3 n = quad.normal();
    const double a = n.dot(from - quad.vertex[0]), b = n.dot(to - quad.vertex[0]);
    if (a * b >= 0) return -1;
    const Vec3 crossing = from + a / (a - b) * (to - from);
    double depth = 1;
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 edge = quad.vertex[(k + 1) % 4] - quad.vertex[k];
        depth = std::min(depth, n.cross(edge).normalized().dot(crossing - quad.vertex[k]));
    }
    return depth;
}

/// The parts of two random quads that face each other; false if there are none.
bool random_facets(Numbers& numbers, Facet& x, Facet& y) {
    const Quad a = random_quad(numbers.vector(-1, 1), 1, numbers);
    const Quad b = random_quad(numbers.vector(-1, 1) + Vec3(0, 0, 2), 1, numbers);
    const Vec3 n = a.normal(), m = b.normal();
    x = Facet::of(a, n).in_front_of(m, m.dot(b.vertex[0]), 1e-9);
    y = Facet::of(b, m).in_front_of(n, n.dot(a.vertex[0]), 1e-9);
    return !x.empty() && !y.empty();
}

TEST(Shaft, IsRightWhereItIsCertain) {
    Numbers numbers(50);
    int clear = 0, covered = 0, suspected = 0, cut = 0;
    for (int k = 0; k < 20000; ++k) {
        Facet x, y;
        if (!random_facets(numbers, x, y)) continue;
        const Shaft shaft(x, y);
        // Small ones that may be missed, and large ones that may cover.
        const Quad quad =
            random_quad(Vec3(0, 0, 1) + numbers.vector(-1, 1), k % 2 == 0 ? 0.4 : 6.0, numbers);
        const bool may_cut = shaft.may_be_cut_by(quad), covers = shaft.is_covered_by(quad);
        EXPECT_TRUE(may_cut || !covers);
        bool any = false;
        for (int ray = 0; ray < 60; ++ray) {
            const double depth = depth_of(random_point(x, numbers), random_point(y, numbers), quad);
            any = any || depth > 0;
            if (!may_cut) {
                ASSERT_LT(depth, 1e-6) << "case " << k << ": a quad that was ruled out blocks";
            }
            if (covers) {
                ASSERT_GT(depth, -1e-6) << "case " << k << ": a quad that covers lets pass";
            }
        }
        clear += may_cut ? 0 : 1;
        covered += covers ? 1 : 0;
        suspected += may_cut ? 1 : 0;
        cut += any ? 1 : 0;
    }
    EXPECT_GT(clear, 1000);
    EXPECT_GT(covered, 100);
    // A shaft that suspects everybody would be right as well, and useless.
    EXPECT_GT(cut, suspected / 2);
}

TEST(Shaft, FindsTheQuadBetweenAndNotTheOneBeside) {
    const auto square = [](double z, double half, double x) {
        return Quad{{Vec3(x - half, -half, z), Vec3(x + half, -half, z), Vec3(x + half, half, z),
                     Vec3(x - half, half, z)}};
    };
    const Quad below = square(0, 1, 0), above = square(2, 1, 0).reversed();
    const Shaft shaft(Facet::of(below, below.normal()), Facet::of(above, above.normal()));
    EXPECT_TRUE(shaft.may_be_cut_by(square(1, 0.1, 0)));
    EXPECT_FALSE(shaft.is_covered_by(square(1, 0.1, 0)));
    EXPECT_FALSE(shaft.is_covered_by(square(1, 0.99, 0)));
    EXPECT_TRUE(shaft.is_covered_by(square(1, 1.01, 0)));
    EXPECT_TRUE(shaft.is_covered_by(square(1, 3, 1)));
    EXPECT_FALSE(shaft.may_be_cut_by(square(1, 0.5, 1.51)));
    EXPECT_TRUE(shaft.may_be_cut_by(square(1, 0.5, 1.49)));
    // Behind one of the two, or in its plane: beside every ray.
    EXPECT_FALSE(shaft.may_be_cut_by(square(-0.5, 3, 0)));
    EXPECT_FALSE(shaft.may_be_cut_by(square(2, 3, 0)));
}

// A cell of a wall and one of the floor, and a block whose edge the shaft between them touches:
// no rounding may make the block stand in the way.
TEST(Shaft, AQuadThatOnlyTouchesIsInNobodysWayHoweverAllIsTurned) {
    const Quad wall{{Vec3(0, 0, 0), Vec3(0, 0.375, 0), Vec3(0, 0.375, 0.5), Vec3(0, 0, 0.5)}};
    const Quad floor{{Vec3(0.5, 2.25, 0), Vec3(1, 2.25, 0), Vec3(1, 3, 0), Vec3(0.5, 3, 0)}};
    const double edge = 4.0 / 9;  // of the shaft, at y = 1
    const Quad side{{Vec3(edge, 1, 0), Vec3(2, 1, 0), Vec3(2, 1, 1), Vec3(edge, 1, 1)}};
    for (const double degrees : {0.0, 37.0, 45.0, 111.0}) {
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(degrees * M_PI / 180, Vec3(1, 2, 3).normalized()).matrix();
        const Vec3 shift = degrees == 0 ? Vec3(0, 0, 0) : Vec3(1000, -1000, 500);
        const auto facet = [&](const Quad& quad) {
            const Quad there = placed(quad, turn, shift);
            return Facet::of(there, there.normal());
        };
        const Shaft shaft(facet(wall), facet(floor));
        EXPECT_FALSE(shaft.may_be_cut_by(placed(side, turn, shift))) << degrees;
        Quad nearer = side;
        for (Vec3& corner : nearer.vertex)
            corner[0] -= 0.01;
        EXPECT_TRUE(shaft.may_be_cut_by(placed(nearer, turn, shift))) << degrees;
    }
}

// A wall between two rooms, and cells of either room that touch it or its edges: no chance and no
// rounding may decide whether light gets through.
TEST(Shaft, AWallCoversCellsThatTouchIt) {
    const Quad wall{{Vec3(4, 0, 0), Vec3(4, 0, 3), Vec3(4, 4, 3), Vec3(4, 4, 0)}};
    const auto facet = [](const Quad& quad) { return Facet::of(quad, quad.normal()); };
    const Facet side{
        facet(Quad{{Vec3(3.5, 4, 1.5), Vec3(4, 4, 1.5), Vec3(4, 4, 2), Vec3(3.5, 4, 2)}})};
    const Facet floor{
        facet(Quad{{Vec3(5, 2, 0), Vec3(5.5, 2, 0), Vec3(5.5, 3, 0), Vec3(5, 3, 0)}})};
    const Facet near{facet(Quad{{Vec3(4, 3, 0), Vec3(5, 3, 0), Vec3(5, 4, 0), Vec3(4, 4, 0)}})};
    EXPECT_TRUE(Shaft(side, floor).is_covered_by(wall));
    EXPECT_TRUE(Shaft(floor, side).is_covered_by(wall));
    EXPECT_TRUE(Shaft(side, near).is_covered_by(wall));
    // What lies in the wall's plane is not behind it.
    EXPECT_FALSE(
        Shaft(facet(wall.reversed().part(0.2, 0.4, 0.2, 0.4)),
              facet(Quad{{Vec3(3, 1, 0), Vec3(3.5, 1, 0), Vec3(3.5, 2, 0), Vec3(3, 2, 0)}}))
            .is_covered_by(wall));
    // A gap of a millimetre under the wall is a gap.
    Quad raised = wall;
    raised.vertex[0][2] = raised.vertex[3][2] = 1e-3;
    EXPECT_FALSE(Shaft(side, near).is_covered_by(raised));
}

}  // namespace
}  // namespace lightwell
