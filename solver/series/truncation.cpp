#include "solver/series/truncation.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>

namespace lightwell {

namespace {

/// The leading bits of a number that is not negative: they order numbers as these themselves do,
/// into classes a sixteenth of an octave wide.
constexpr int leading_bits = 16;

std::size_t class_of(double magnitude) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &magnitude, sizeof bits);
    return static_cast<std::size_t>(bits >> (64 - leading_bits));
}

}  // namespace

double threshold_for_budget(const std::vector<double>& magnitudes, double budget) {
    // By classes first, then within the one that exceeds the budget: sorting all takes seconds
    // where a scene has tens of millions of coefficients.
    std::vector<double> squares(std::size_t{1} << leading_bits, 0.0);
    std::vector<bool> is_met(squares.size(), false);
    for (const double m : magnitudes) {
        squares[class_of(m)] += m * m;
        is_met[class_of(m)] = true;
    }
    const double allowed = budget * budget;
    double spent = 0;
    for (std::size_t c = 0; c < squares.size(); ++c) {
        if (!is_met[c]) continue;
        if (spent + squares[c] <= allowed) {
            spent += squares[c];
            continue;
        }
        std::vector<double> alike;
        std::copy_if(magnitudes.begin(), magnitudes.end(), std::back_inserter(alike),
                     [c](double m) { return class_of(m) == c; });
        std::sort(alike.begin(), alike.end());
        for (const double m : alike) {
            if (spent + m * m > allowed) return m;
            spent += m * m;
        }
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace lightwell
