#include "solver/transport/directional_oracle.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/basis/samples.h"
#include "tests/unit/transport/box.h"

namespace lightwell {
namespace {

/// Two facing squares, cut to the same cells in space, with directions on the first.
class FacingSquares : public ::testing::Test {
  protected:
    DirectedCandidate link(int receiver_level, int sender_level, double exchange) const {
        DirectedCandidate result{end(0, receiver_level), end(1, sender_level), exchange, 3};
        return result;
    }

    static bool has(const DirectedVerdict& verdict, SubDomain domain) {
        return (verdict.sub_domains & domain) != 0;
    }

    std::vector<Element> elements = [] {
        const Quad below{{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 2, 0), Vec3(0, 2, 0)}};
        const Quad above{{Vec3(0, 0, 3), Vec3(0, 2, 3), Vec3(2, 2, 3), Vec3(2, 0, 3)}};
        std::vector<Element> made = testing::uniform_elements({below, above}, 4);
        made[0].angle = angular_basis(3).tree();
        return made;
    }();
    AngularDetail detailed = {1, 0.9, 0.5, 0}, none = {0};
    DirectionalOracle oracle{{1e-3}, 8};

  private:
    DirectedEnd end(std::size_t e, int level) const {
        DirectedEnd result;
        result.element = &elements[e];
        result.detail = e == 0 ? &detailed : &none;
        result.space = {level, 0};
        result.outline = elements[e].cell(result.space);
        for (const Vec3& corner : result.outline.vertex)
            result.reach = std::max(result.reach, (corner - result.outline.centre()).norm());
        return result;
    }
};

TEST_F(FacingSquares, DoesNotLinkANarrowLobeToAWideReceiver) {
    const DirectedVerdict verdict = oracle.judge(link(3, 0, 0.05));
    EXPECT_TRUE(has(verdict, sender_space));
    EXPECT_FALSE(has(verdict, receiver_space));
    EXPECT_TRUE(has(verdict, receiver_angle));
    EXPECT_FALSE(has(verdict, sender_angle));
}

TEST_F(FacingSquares, RefinesSpaceOnBothSidesWhereTheyAreAlike) {
    const DirectedVerdict verdict = oracle.judge(link(0, 0, 0.5));
    EXPECT_TRUE(has(verdict, sender_space));
    EXPECT_TRUE(has(verdict, receiver_space));
}

TEST_F(FacingSquares, KeepsWhatDoesNotMatter) {
    const DirectedVerdict verdict = oracle.judge(link(0, 0, 1e-5));
    EXPECT_FALSE(has(verdict, sender_space));
    EXPECT_FALSE(has(verdict, receiver_space));
}

// The directions of a link are told apart as far as the other end fills them, if not farther.
TEST_F(FacingSquares, TiesDirectionsToWhereTheOtherEndLies) {
    const int wide = oracle.judge(link(0, 0, 1e-5)).receiver_angle;
    const int narrow = oracle.judge(link(4, 4, 1e-5)).receiver_angle;
    EXPECT_LT(wide, narrow);
    EXPECT_EQ(narrow, 3);
    EXPECT_EQ(oracle.judge(link(4, 4, 1e-5)).sender_angle, 0);
}

TEST_F(FacingSquares, LeavesFinestCells) {
    const DirectedVerdict verdict = DirectionalOracle({0}, 8).judge(link(4, 4, 1));
    EXPECT_FALSE(has(verdict, sender_space));
    EXPECT_FALSE(has(verdict, receiver_space));
    EXPECT_EQ(verdict.receiver_angle, 3);
}

// Broad lobes do without fine directions, narrow ones do not.
TEST(AngularDetailOfLobes, GrowsWithTheExponent) {
    const auto detail = [](double exponent, double diffuse) {
        return angular_detail(
            AngularReflection::at_level(PhongLobe{Rgb::Constant(0.7), exponent}, 3), diffuse, 0.7);
    };
    const AngularDetail broad = detail(2, 0), narrow = detail(50, 0), mixed = detail(50, 0.7);
    ASSERT_EQ(narrow.size(), 4U);
    for (std::size_t level = 0; level < 3; ++level) {
        EXPECT_LT(broad[level], narrow[level]) << level;
        EXPECT_LT(mixed[level], narrow[level]) << level;
        EXPECT_GE(narrow[level], narrow[level + 1]) << level;
    }
    EXPECT_LT(broad[2], 0.1);
    EXPECT_GT(narrow[2], 0.2);
    EXPECT_EQ(narrow[3], 0);
}

}  // namespace
}  // namespace lightwell
