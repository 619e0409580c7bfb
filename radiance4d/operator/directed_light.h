#pragma once

#include "radiance4d/operator/radiance_field.h"

namespace lightwell {

/// Adds the light of a point source to a field over an element with angular functions: the light on
/// each finest spatial cell enters the angular cells around its direction (see angular_shares), in
/// proportion to the flux on the parts of the cell from which it comes through each.
///
/// @param from        where the source stands [m]
/// @param irradiance  of the element's finest cells by this source [lx], shadows included
/// @param field       over the whole space; the element's coefficients are added to
void add_directed_light(const Element& element, const Vec3& from, const RadianceField& irradiance,
                        RadianceField& field);

/// The field as if what arrives at each place came evenly from all directions: how the paper takes
/// direct light on glossy surfaces (WRT section 5.1), to compare with. Irradiance stays.
RadianceField without_directions(const RadianceSpace& space, RadianceField field);

}  // namespace lightwell
