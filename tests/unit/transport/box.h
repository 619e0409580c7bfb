#pragma once

#include <array>
#include <vector>

#include "radiance4d/operator/radiance_field.h"

namespace lightwell::testing {

/// The six walls of the box [0,x] x [0,y] x [0,z] seen from inside, in the order x0, x1, y0, y1,
/// floor, ceiling.
std::vector<Quad> box_walls(const Vec3& size);

/// The front of each quad as an element, every domain halved both ways `levels` times.
std::vector<Element> uniform_elements(const std::vector<Quad>& quads, int levels);

/// Refines every pair down to the finest cells and solves X = E + M rho X to rounding.
/// @param irradiance mean direct irradiance [lx] of each element's finest cells
/// @return irradiance of the solution, by element
std::vector<RadianceField> solve_uniform(const std::vector<Quad>& quads, int levels,
                                         const std::vector<Rgb>& reflectance,
                                         const std::vector<RadianceField>& irradiance);

}  // namespace lightwell::testing
