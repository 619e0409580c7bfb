#include "runtime/outgoing/square_mean.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// Mean 1: a bright square of the given side and nothing else.
SquareMean::Function bright_square(double x, double y, double side) {
    return [=](const Vec2& at) -> Rgb {
        const bool inside = at[0] >= x && at[0] < x + side && at[1] >= y && at[1] < y + side;
        return Rgb::Constant(inside ? 1 / (side * side) : 0);
    };
}

/// Root mean square error over many places of the bright square.
double error_of(int strata, double side) {
    const SquareMean mean(strata);
    double squares = 0;
    constexpr int places = 200;
    for (int k = 0; k < places; ++k) {
        const double x = std::fmod(0.754877666 * k, 1.0) * (1 - side);
        const double y = std::fmod(0.569840291 * k, 1.0) * (1 - side);
        squares += std::pow(mean.of(bright_square(x, y, side))[1] - 1, 2);
    }
    return std::sqrt(squares / places);
}

TEST(SquareMean, OfWhatIsEvenIsExact) {
    for (const int strata : {1, 2, 7, 40})
        EXPECT_NEAR(SquareMean(strata).of([](const Vec2&) -> Rgb {
            return {1, 2, 3};
        })[2],
                    3, 1e-13)
            << strata;
}

TEST(SquareMean, ConvergesForSmoothFunctions) {
    const auto slope = [](const Vec2& at) -> Rgb {
        return Rgb::Constant(std::exp(at[0]) * std::cos(at[1]));
    };
    const double exact = (std::exp(1.0) - 1) * std::sin(1.0);
    const auto error = [&](int strata) {
        return std::abs(SquareMean(strata).of(slope)[0] - exact);
    };
    EXPECT_LT(error(16), 0.01 * exact);
    EXPECT_LT(error(64), 0.001 * exact);
}

TEST(SquareMean, CastsAboutTheSquareOfItsStrata) {
    for (const int strata : {1, 5, 32}) {
        int asked = 0;
        SquareMean(strata).of([&asked](const Vec2& at) -> Rgb {
            ++asked;
            EXPECT_TRUE((at.array() >= 0).all() && (at.array() <= 1).all());
            return Rgb::Constant(at[0] > 0.3);
        });
        EXPECT_EQ(asked, strata * strata) << strata;
    }
}

/// n values spread evenly, one by stratum, find the share of a square of side a in the unit square
/// to about n^(-3/4) a^(-3/2): only the strata on its outline err. 32^2 and a = 1/10 make 0.17.
TEST(SquareMean, SmallBrightPlacesGetMostValues) {
    EXPECT_LT(error_of(32, 0.1), 0.17 / 4);
    EXPECT_LT(error_of(64, 0.1), 0.06 / 4);
}

/// Where a value calls for others beside it, mixed strata that came out bright are thinned out and
/// those that came out dark are not: 2 % are lost here.
TEST(SquareMean, IsNotBiasedByWhereItLooks) {
    const SquareMean mean(32);
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform;
    constexpr double side = 0.1;
    constexpr int places = 4000;
    double sum = 0;
    for (int k = 0; k < places; ++k) {
        const Vec2 corner(uniform(random), uniform(random));
        // Around the edges of the unit square, so that every point is in it as often.
        sum += mean.of([&corner](const Vec2& at) -> Rgb {
            const Vec2 off = at - corner;
            const bool inside =
                off[0] - std::floor(off[0]) < side && off[1] - std::floor(off[1]) < side;
            return Rgb::Constant(inside ? 1 / (side * side) : 0);
        })[0];
    }
    EXPECT_NEAR(sum / places, 1, 0.005);
}

}  // namespace
}  // namespace lightwell
