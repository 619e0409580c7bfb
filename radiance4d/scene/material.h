#pragma once

#include <string>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// Which sides of a quad take part in something.
enum class Sides { front, both };

/// A diffuse (Lambertian) surface.
struct Material {
    std::string name;
    /// Albedo rho per channel, in [0,1].
    Rgb reflectance = Rgb::Constant(0.5);
    /// Emitted luminance [cd/m2], diffuse, >= 0; the exitance is pi times this [lm/m2].
    Rgb emission = Rgb::Zero();
    /// Sides that reflect. The other side is opaque and black.
    Sides reflecting = Sides::both;
    /// Sides that emit.
    Sides emitting = Sides::front;
};

}  // namespace lightwell
