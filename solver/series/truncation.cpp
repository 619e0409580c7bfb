#include "solver/series/truncation.h"

#include <algorithm>
#include <limits>

namespace lightwell {

double threshold_for_budget(std::vector<double> magnitudes, double budget) {
    // Halves the range that the answer lies in, at a cost linear in all: a full sort takes seconds
    // where a scene has tens of millions of coefficients.
    auto low = magnitudes.begin(), high = magnitudes.end();
    double spent = 0;  // by all below `low`
    const double allowed = budget * budget;
    while (high - low > 1) {
        const auto middle = low + (high - low) / 2;
        std::nth_element(low, middle, high);
        double below = 0;
        for (auto m = low; m != middle; ++m)
            below += *m * *m;
        if (spent + below > allowed) {
            high = middle;
        } else {
            spent += below;
            low = middle;
        }
    }
    if (low == high) return std::numeric_limits<double>::infinity();
    if (spent + *low * *low > allowed) return *low;
    return high == magnitudes.end() ? std::numeric_limits<double>::infinity() : *high;
}

}  // namespace lightwell
