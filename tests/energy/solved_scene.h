#pragma once

#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "runtime/propagation/lighting.h"

namespace lightwell::testing {

/// A scene precomputed to an error and lit, all in this process.
struct SolvedScene {
    GlobalTransport transport;
    Lighting lighting;

    /// Mean irradiance of the finest cells of an element, direct and indirect [lx].
    RadianceField total(std::size_t element) const;
    /// Mean over the open surface of one element, or of all [lx].
    Rgb mean_indirect(std::size_t element) const;
    Rgb mean_indirect() const;
    Rgb mean_total() const;
};

/// @param attempts  as PrecomputeOptions::most_attempts
SolvedScene solved_scene(const Scene& scene, const std::vector<Light>& lights, double error,
                         int attempts = 0);

}  // namespace lightwell::testing
