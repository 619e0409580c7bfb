#include "solver/series/truncation.h"

#include <algorithm>
#include <limits>

namespace lightwell {

double threshold_for_budget(std::vector<double> magnitudes, double budget) {
    std::sort(magnitudes.begin(), magnitudes.end());
    double spent = 0;
    for (const double magnitude : magnitudes) {
        spent += magnitude * magnitude;
        if (spent > budget * budget) return magnitude;
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace lightwell
