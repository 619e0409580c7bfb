#pragma once

#include "radiance4d/scene/scene.h"

namespace lightwell {

/// A normalised modified Phong lobe that reflects 0.7.
inline Lobe phong(double exponent) {
    return PhongLobe{Rgb::Constant(0.7), exponent};
}

/// A GGX lobe that reflects 0.7.
inline Lobe ggx(double roughness) {
    return GgxLobe{Rgb::Constant(0.7), roughness};
}

/// A closed box of 3 x 2 x 2.5 m whose floor is of that lobe and a diffuse part; the rest is
/// diffuse.
Scene box_with_floor(const Lobe& lobe, double diffuse);

}  // namespace lightwell
