#pragma once

#include <vector>

#include "solver/reference/path_tracer.h"

namespace lightwell {

/// How estimates stand against exact values, channel by channel.
struct ZTest {
    int tested = 0;
    int outside = 0;           ///< farther off than the allowed number of standard errors
    double worst = 0;          ///< largest distance [standard errors]
    double largest_noise = 0;  ///< largest standard error, relative to the exact value

    bool passes() const { return tested > 0 && outside * 100 <= tested; }
};

/// Compares every channel; passes() when at least 99 % lie within `allowed` standard errors.
ZTest z_test(const std::vector<LightEstimate>& estimates, const std::vector<Rgb>& exact,
             double allowed = 4);

}  // namespace lightwell
