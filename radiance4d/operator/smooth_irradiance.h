#pragma once

#include <vector>

#include "radiance4d/basis/smooth_surface.h"
#include "radiance4d/operator/radiance_field.h"

namespace lightwell {

/// Smooth irradiance [lx] over every element, by element number. Buried parts, which nobody sees,
/// carry on for two cells what is around them; further in it is dark.
std::vector<SmoothSurface> smooth_irradiance(const RadianceSpace& space,
                                             const RadianceField& field);
/// The same over one element.
SmoothSurface smooth_irradiance(const RadianceSpace& space, std::size_t element,
                                const RadianceField& field);

}  // namespace lightwell
