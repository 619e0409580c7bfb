#pragma once

#include <vector>

#include "solver/reference/light_estimate.h"

namespace lightwell {

/// How much noise is welcome.
struct NoiseTarget {
    /// Standard error of luminance over the point's own mean, or over `floor` times the root mean
    /// square of the means of all points, whichever allows more.
    double relative = 0.01;
    /// 0: every point to its own measure, however dark. 1: dark points only as far as they matter
    /// for the root mean square error over the points, several times cheaper.
    double floor = 0.1;
    int most_samples = 1 << 20;  ///< per point, whatever the noise
};

/// Paths that each point of a trial run needs to meet the target, one number per point.
/// @param samples  that every point of the trial had
/// @param batches  of the trial and the run to come; no point gets less than four paths in each
std::vector<int> samples_for(const NoiseTarget& target, const std::vector<LightEstimate>& trial,
                             int samples, int batches);

}  // namespace lightwell
