#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "radiance4d/progress.h"
#include "radiance4d/scene/occluder_tree.h"
#include "radiance4d/scene/visibility.h"
#include "solver/reference/surface_points.h"

namespace lightwell {

/// How much is asked of the judge.
struct EstimateOptions {
    int points = 200;     ///< surface points a light, spread evenly by area
    double noise = 0.03;  ///< of the judge at a point, relative to the rms over the points; its
                          ///< variance is taken off
    std::uint64_t seed = 1;
};

/// The error of an operator for some lights, judged by path tracing.
struct ErrorEstimate {
    /// By light: relative root mean square over the surface of the indirect illuminance that a
    /// picture shows (the gathered operator, reconstructed smoothly) against the judge.
    std::vector<double> by_light;
    double energy_dropped =
        0;  ///< share of the indirect flux that the stored operator lacks against the solved one
    std::int64_t rays = 0;  ///< traced by the judge

    /// Root mean square over the lights.
    double rms() const;
    /// The error that nine lights of ten stay below, from the lights there are.
    double ninth_of_ten() const;
};

/// Judges the operator for white unit lights at the given positions, one at a time, emitters off.
ErrorEstimate estimate_error(const GlobalTransport& transport, const std::vector<Quad>& quads,
                             const OccluderTree& occluders, const Visibility& visibility,
                             const std::vector<Vec3>& positions, const EstimateOptions& options,
                             const Progress& progress);

}  // namespace lightwell
