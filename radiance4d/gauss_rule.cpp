#include "radiance4d/gauss_rule.h"

#include <array>
#include <cmath>

namespace lightwell {

namespace {

/// Legendre's polynomial of the given degree and its derivative at x in (-1,1).
std::array<double, 2> legendre(int degree, double x) {
    double before = 1, value = x;
    for (int k = 2; k <= degree; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = next;
    }
    return {value, degree * (x * value - before) / (x * x - 1)};
}

}  // namespace

GaussRule::GaussRule(int count) {
    for (int k = 0; k < count; ++k) {
        double x = -std::cos(M_PI * (k + 0.75) / (count + 0.5));
        if (2 * k + 1 == count) x = 0;
        for (int step = 0; step < 6; ++step) {
            const auto [value, slope] = legendre(count, x);
            x -= value / slope;
        }
        const double slope = legendre(count, x)[1];
        nodes.push_back(0.5 * (1 + x));
        weights.push_back(1 / ((1 - x * x) * slope * slope));
    }
}

}  // namespace lightwell
