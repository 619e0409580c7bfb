#include "solver/transport/directed_refiner.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "radiance4d/basis/angular_reflection.h"
#include "radiance4d/basis/angular_shares.h"
#include "radiance4d/basis/direction_map.h"
#include "radiance4d/operator/radiance_field.h"
#include "solver/series/bounce_truncation.h"
#include "solver/transport/directed_transport.h"
#include "solver/transport/geometric_oracle.h"
#include "solver/transport/refiner.h"
#include "tests/unit/basis/samples.h"
#include "tests/unit/transport/box.h"

namespace lightwell {
namespace {

constexpr int space_levels = 3, angle_levels = 2;

/// A closed box whose floor and one wall have directions, and the links in space between its sides.
class HalfDirectedBox : public ::testing::Test {
  protected:
    HalfDirectedBox() {
        elements = testing::uniform_elements(quads, space_levels);
        for (const std::size_t e : {0, 4})
            elements[e].angle = angular_basis(angle_levels).tree();
        for (const Element& element : elements)
            detail.push_back(element.angle.levels() > 0 ? AngularDetail{1, 0.8, 0}
                                                        : AngularDetail{0});
        space = RadianceSpace(elements);
        elements = space.elements();
        const GeometricOracle oracle(GeometricOracleOptions{2e-3, 2e-3}, quads, visibility,
                                     space.area());
        OracleCost cost;
        given = refine_links(elements, quads, OccluderTree(quads), oracle, {}, cost);
    }

    std::vector<DirectedPair> refined(double tolerance, int points = 12) const {
        OracleCost cost;
        return refine_directions(elements, detail, given,
                                 DirectionalOracle({tolerance}, space.area()), visibility, {points},
                                 {}, cost);
    }

    SymmetricOperator propagation(std::vector<DirectedPair> directions) const {
        const std::vector<bool> closed(elements.size(), true);
        close_directions(elements, closed, directions);
        return BounceTruncation(space, closed, directed_transport(space, directions, {}),
                                Eigen::ArrayXd::Ones(static_cast<Eigen::Index>(space.functions())))
            .at(0);
    }

    const std::vector<Quad> quads = testing::box_walls({2, 1.5, 1.2});
    const Visibility visibility{quads};
    std::vector<Element> elements;
    std::vector<AngularDetail> detail;
    RadianceSpace space;
    std::vector<PairLinks> given;
};

bool overlap(const CellTree& tree, std::uint32_t a, std::uint32_t b) {
    Cell x = tree.at(a), y = tree.at(b);
    while (x.level > y.level)
        x = tree.parent(x);
    while (y.level > x.level)
        y = tree.parent(y);
    return x == y;
}

std::size_t count(const std::vector<DirectedPair>& pairs) {
    std::size_t links = 0;
    for (const DirectedPair& pair : pairs)
        links += pair.links.size();
    return links;
}

TEST_F(HalfDirectedBox, KeepsWhatPairsExchange) {
    for (const double tolerance : {1.0, 1e-3}) {
        const std::vector<DirectedPair> directions = refined(tolerance);
        ASSERT_EQ(directions.size(), given.size());
        for (std::size_t p = 0; p < given.size(); ++p) {
            double before = 0, after = 0;
            for (const LinkValue& link : given[p].links)
                before += link.exchange;
            for (const DirectedLink& link : directions[p].links)
                after += link.exchange;
            EXPECT_NEAR(after, before, 1e-12 * before) << p;
        }
    }
}

TEST_F(HalfDirectedBox, RefinesAsFarAsItMatters) {
    const std::size_t coarse = count(refined(1)), fine = count(refined(2e-3)),
                      finest = count(refined(0));
    EXPECT_GT(fine, coarse);
    EXPECT_GT(finest, fine);
    EXPECT_GT(5 * finest, 6 * coarse);
}

// However it was reached, no transfer is counted twice: the links of a pair are disjoint.
TEST_F(HalfDirectedBox, VisitsNothingTwice) {
    for (const DirectedPair& pair : refined(2e-3)) {
        const Element &x = elements[pair.receiver], &y = elements[pair.sender];
        if (x.angle.levels() + y.angle.levels() == 0) continue;
        for (std::size_t i = 0; i < pair.links.size(); i += 4)  // a sample: pairs are many
            for (std::size_t j = 0; j < i; ++j) {
                const DirectedLink &a = pair.links[i], &b = pair.links[j];
                ASSERT_FALSE(overlap(x.space.tree(), a.receiver, b.receiver) &&
                             overlap(x.angle, a.receiver_angle, b.receiver_angle) &&
                             overlap(y.space.tree(), a.sender, b.sender) &&
                             overlap(y.angle, a.sender_angle, b.sender_angle))
                    << pair.receiver << " " << pair.sender;
            }
    }
}

// At finest cells in space and direction, links whose angular cells do not point at the other end
// are not there: some direction to the other cell, seen from anywhere in this one, belongs to each.
TEST_F(HalfDirectedBox, DropsLobesThatPointElsewhere) {
    constexpr int steps = 12;
    for (const DirectedPair& pair : refined(0)) {
        const Element &x = elements[pair.receiver], &y = elements[pair.sender];
        if (x.angle.levels() == 0) continue;
        const Eigen::Matrix3d frame = local_frame(x.geometry);
        std::size_t looked = 0;
        for (const DirectedLink& link : pair.links) {
            if (++looked % 97 != 0) continue;
            const Quad from = x.cell(x.space.tree().at(link.receiver));
            const Quad to = y.cell(y.space.tree().at(link.sender));
            std::set<std::uint32_t> pointed_at;
            for (int k = 0; k < steps * steps * steps * steps; ++k) {
                const auto at = [&](int digit) {
                    return (k / static_cast<int>(std::pow(steps, digit)) % steps + 0.5) / steps;
                };
                const Vec3 direction = to.point(at(0), at(1)) - from.point(at(2), at(3));
                for (const AngularShare& one :
                     angular_shares(x.angle, angle_levels, frame.transpose() * direction))
                    if (one.share > 0)
                        pointed_at.insert(x.angle.position({angle_levels, one.cell}));
            }
            const bool is_finest = x.angle.at(link.receiver_angle).level == angle_levels;
            ASSERT_TRUE(is_finest);
            EXPECT_LT(pointed_at.size(), x.angle.functions());
            // The grid misses slivers of cells that quasi-random points may hit.
            if (link.exchange > 0.05 * x.space.area_at(link.receiver) / 16) {
                EXPECT_EQ(pointed_at.count(link.receiver_angle), 1U);
            }
        }
    }
}

// What links to the finest cells by rays give, the slow and obvious way.
TEST_F(HalfDirectedBox, CarriesWhatRaysCarry) {
    OracleCost cost;
    DirectedLinkOptions many;
    many.rays = 256;
    const SymmetricOperator by_rays =
        propagation(directed_links(elements, given, visibility, many, {}, cost));
    const auto n = static_cast<Eigen::Index>(space.functions());
    Eigen::VectorXd sent = Eigen::VectorXd::Zero(n), rays_carry = sent;
    testing::Numbers numbers(7);
    for (const Element& element : elements)  // light that varies over coarse cells and directions
        for (std::uint32_t f = 0; f < 16; ++f)
            for (std::uint32_t a = 0; a < element.angle.functions(); ++a)
                sent[element.first + f * element.angle.functions() + a] =
                    numbers.between(-1, 1) + (f + a == 0 ? 4 : 0);
    by_rays.apply(sent, rays_carry);
    const auto off_at = [&](double tolerance) {
        Eigen::VectorXd carried = Eigen::VectorXd::Zero(n);
        propagation(refined(tolerance, 96)).apply(sent, carried);
        return (carried - rays_carry).norm() / rays_carry.norm();
    };
    const double finest = off_at(0);
    EXPECT_LT(finest, 0.03);
    EXPECT_GT(off_at(1), 2 * finest);
}

}  // namespace
}  // namespace lightwell
