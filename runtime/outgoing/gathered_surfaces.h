#pragma once

#include <functional>
#include <vector>

#include "radiance4d/basis/smooth_surface.h"
#include "runtime/outgoing/final_gather.h"

namespace lightwell {

/// Smooth indirect irradiance [lx] by element, as smooth_irradiance gives it, but with the mean of
/// every finest cell gathered anew at `points` x `points` of its points. It costs points^2 * cells
/// gathers, and is free of the unevenness from cell to cell that the stored coefficients leave.
///
/// Points that receive nothing are left out of a cell's mean: they lie under what stands there.
/// @param check called now and then, from several threads; may throw to stop the work
std::vector<SmoothSurface> gathered_surfaces(const RadianceSpace& space, const FinalGather& gather,
                                             int points, const std::function<void()>& check);

}  // namespace lightwell
