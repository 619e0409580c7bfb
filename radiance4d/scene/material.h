#pragma once

#include <string>
#include <variant>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// Which sides of a quad take part in something.
enum class Sides { front, both };

/// No gloss: the surface is diffuse (Lambertian).
struct NoLobe {};

/// Normalised modified Phong lobe (Lafortune and Willems 1994; the BRDF of WRT),
/// f = reflectance (n+2)/(2 pi) max(0, cos alpha)^n, alpha the angle to the mirror direction.
struct PhongLobe {
    Rgb reflectance = Rgb::Zero();  ///< albedo at normal incidence, in [0,1]; less elsewhere
    double exponent = 10;           ///< n, in [0, 10000]
};

/// GGX microfacets with height-correlated Smith shadowing (Walter et al. 2007, Heitz 2014), each a
/// mirror of the given reflectance: f = reflectance D G2 / (4 cos_i cos_o).
struct GgxLobe {
    Rgb reflectance = Rgb::Zero();  ///< of one facet, in [0,1]; the albedo nowhere exceeds it
    double roughness = 0.5;         ///< alpha, the slope of the facets, in [0.01, 1]
};

/// Every kind of gloss there is. brdf.h says what each does to light.
using Lobe = std::variant<NoLobe, PhongLobe, GgxLobe>;

/// A surface: diffuse, and glossy where it has a lobe.
struct Material {
    std::string name;
    /// Albedo rho of the diffuse part per channel, in [0,1].
    Rgb reflectance = Rgb::Constant(0.5);
    /// Emitted luminance [cd/m2], diffuse, >= 0; the exitance is pi times this [lm/m2].
    Rgb emission = Rgb::Zero();
    /// Sides that reflect. The other side is opaque and black.
    Sides reflecting = Sides::both;
    /// Sides that emit.
    Sides emitting = Sides::front;
    /// What it reflects beside the diffuse part.
    Lobe lobe = NoLobe{};
};

}  // namespace lightwell
