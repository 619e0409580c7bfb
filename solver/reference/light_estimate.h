#pragma once

#include <vector>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// An amount of light with its noise. Over repeated seeds the mean has no bias.
struct LightEstimate {
    Rgb mean = Rgb::Zero();
    Rgb standard_error = Rgb::Zero();  ///< one standard deviation of the mean, from the batches
};

/// Mean and standard error of the mean of independent batch means, at least two.
LightEstimate estimate_from_batches(const std::vector<Rgb>& batch_means);

}  // namespace lightwell
