#pragma once

#include <vector>

namespace lightwell {

/// Nodes and weights of the Gauss-Legendre rule on [0,1]; `count` nodes integrate polynomials of
/// degree 2 count - 1.
struct GaussRule {
    std::vector<double> nodes, weights;

    explicit GaussRule(int count);
};

}  // namespace lightwell
