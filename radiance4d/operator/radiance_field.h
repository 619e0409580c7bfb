#pragma once

#include <Eigen/Core>

#include "radiance4d/basis/radiance_space.h"

namespace lightwell {

/// Coefficients of a radiance field in a RadianceSpace: one row per basis function, one column per
/// channel (linear Rec. 709). The field is incident radiance as a half-density, so the norm of a
/// column is the physical L2 norm,
/// ||L||^2 = Int Int L^2 cos(theta)/pi dw dA. On a diffuse element it carries the angular mean Lbar
/// = E/pi [cd/m2].
using RadianceField = Eigen::Array<double, Eigen::Dynamic, 3>;

/// Irradiance of all finest cells of an element [lx], one row per cell in cell order: pi times the
/// angular mean of the field over the cell.
RadianceField cell_irradiance(const RadianceSpace& space, std::size_t element,
                              const RadianceField& field);

/// Inverse of cell_irradiance: sets the element's coefficients in `field` from the mean irradiance
/// [lx] of its finest cells.
void set_cell_irradiance(const RadianceSpace& space, std::size_t element,
                         const RadianceField& irradiance, RadianceField& field);

/// Total flux that the field brings to all elements [lm], per channel: the integral of irradiance
/// over area.
Rgb total_flux(const RadianceSpace& space, const RadianceField& field);

}  // namespace lightwell
