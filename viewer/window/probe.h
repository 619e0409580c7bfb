#pragma once

#include <functional>
#include <string>
#include <vector>

#include "viewer/commands/opened_operator.h"
#include "viewer/window/visit.h"

namespace lightwell {

/// What one light, or all emitting quads together, bring to a point, bounce by bounce [lx].
struct LightShare {
    std::string name;
    double direct = 0;
    std::vector<double> bounces;  ///< light that was reflected once, twice, ...

    double indirect() const;
};

/// Illuminance at a point [lx], in parts.
struct ProbeReading {
    std::vector<LightShare> shares;  ///< by light; emitting quads last, if there are any

    double direct() const;
    double indirect() const;
    /// Of all lights, by bounce.
    std::vector<double> bounces() const;
};

/// Reads the light at a point of a surface: direct light exactly, every bounce by the direct
/// transport operator that the file holds, until what follows is less than a thousandth of the
/// whole. Costs one product with that operator per light and bounce.
/// @param stop_requested  asked between bounces; the reading ends there if it says so
ProbeReading read_probe(const OpenedOperator& opened, const std::vector<Light>& lights,
                        const ProbedPoint& point, const std::function<bool()>& stop_requested);

}  // namespace lightwell
