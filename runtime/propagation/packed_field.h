#pragma once

#include <Eigen/Core>

#include "radiance4d/operator/radiance_field.h"

namespace lightwell {

/// The red, green and blue of one coefficient, and a fourth number that is zero.
using Packed = Eigen::Array4f;

/// A RadianceField laid out for the run time: one column per basis function, so that a function's
/// three channels lie side by side and are worked on together, in single precision. The fourth row
/// is zero.
using PackedField = Eigen::Array<float, 4, Eigen::Dynamic>;

PackedField packed(const RadianceField& field);
RadianceField unpacked(const PackedField& field);

}  // namespace lightwell
