#pragma once

#include <vector>

#include "solver/reference/path_tracer.h"

namespace lightwell {

/// How far a solver's values lie from a noisy reference.
struct Deviation {
    /// Relative root mean square difference, sqrt(sum d^2 / sum E^2) over points and channels, with
    /// the part that the reference's noise makes up taken out (its expectation, on both sums); 0
    /// where nothing is left.
    double relative_rms = 0;
    /// The reference's own noise in the same measure. A relative_rms well below it is not known
    /// well: its square is uncertain by about noise^2 sqrt(2 / values).
    double noise = 0;
    /// Signed: sum d / sum E over points and channels; 0 where the reference is dark.
    double bias = 0;
    /// Root mean square of the reference itself over points and channels, its noise taken out [lx];
    /// 0 where it is dark, which leaves nothing to be relative to.
    double reference_rms = 0;

    // The sums behind these, as means over the weight, channels added. Free of bias over repeated
    // seeds, so that they may be averaged; a square may therefore come out below 0.
    double square = 0;            ///< of d^2 [lx2]
    double mean = 0;              ///< of d [lx]
    double reference_square = 0;  ///< of E^2 [lx2]
    double reference_mean = 0;    ///< of E [lx]
};

/// Compares irradiances [lx] point by point; both lists have the same length.
/// @param weight  by point, >= 0: how much it counts in all sums; empty: all alike
Deviation deviation_from(const std::vector<LightEstimate>& reference,
                         const std::vector<Rgb>& values, const std::vector<double>& weight = {});

}  // namespace lightwell
