#include "runtime/outgoing/square_mean.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

/// How much the values around each place of a grid differ from each other. The value there has no
/// say: where it called for company, bright ones would be thinned out more than dark ones, and the
/// mean would come out too dark.
std::vector<double> differences_around(const std::vector<Rgb>& value, int side) {
    std::vector<double> result;
    result.reserve(value.size());
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            Rgb sum = Rgb::Zero(), squares = Rgb::Zero();
            int count = 0;
            for (int j = std::max(0, row - 1); j <= std::min(side - 1, row + 1); ++j)
                for (int i = std::max(0, column - 1); i <= std::min(side - 1, column + 1); ++i) {
                    if (j == row && i == column) continue;
                    const Rgb& one = value[static_cast<std::size_t>(j * side + i)];
                    sum += one;
                    squares += one.square();
                    ++count;
                }
            const Rgb variance = squares - sum.square() / std::max(1, count);
            result.push_back(std::sqrt(variance.max(0.0).sum()));
        }
    return result;
}

/// The point k steps on in the additive sequence on the plane's golden ratio (Roberts 2018).
Vec2 further(const Vec2& within, int k) {
    const double u = within[0] + 0.75487766624669276 * k, v = within[1] + 0.56984029099805327 * k;
    return {u - std::floor(u), v - std::floor(v)};
}

}  // namespace

SquareMean::SquareMean(int strata)
    : side_(static_cast<int>(std::ceil(std::sqrt(0.5) * strata))),
      second_(strata * strata - side_ * side_) {
    LIGHTWELL_CHECK_OP(strata, >=, 1);
    std::mt19937_64 random(20060626);
    const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    for (int k = 0; k < side_ * side_; ++k) {
        const double u = uniform();
        point_.emplace_back(u, uniform());
    }
}

Rgb SquareMean::of(const Function& function) const {
    const auto in_stratum = [&](std::size_t n, const Vec2& within) {
        const auto side = static_cast<std::size_t>(side_);
        return Vec2((static_cast<double>(n % side) + within[0]) / side_,
                    (static_cast<double>(n / side) + within[1]) / side_);
    };
    std::vector<Rgb> value(point_.size());
    for (std::size_t n = 0; n < point_.size(); ++n)
        value[n] = function(in_stratum(n, point_[n]));

    const std::vector<double> deviation = differences_around(value, side_);
    double all = 0;
    for (const double one : deviation)
        all += one;
    Rgb sum = Rgb::Zero();
    double passed = 0;
    int given = 0;
    for (std::size_t n = 0; n < value.size(); ++n) {
        passed += deviation[n];
        const int due = all > 0 ? static_cast<int>(std::lround(second_ * (passed / all))) : 0;
        const int more = due - given;
        given = due;
        Rgb stratum = value[n];
        for (int k = 1; k <= more; ++k)
            stratum += function(in_stratum(n, further(point_[n], k)));
        sum += stratum / (1 + more);
    }
    return sum / static_cast<double>(value.size());
}

}  // namespace lightwell
