#pragma once

#include <optional>
#include <string>
#include <vector>

#include "radiance4d/scene/material.h"
#include "solver/reading/reading_report.h"

namespace lightwell {

/// Largest luminance [cd/m2] and intensity [cd] a file may hold: far beyond any light, and far from
/// where sums and squares overflow.
constexpr double brightest = 1e30;

/// Largest exponent of a Phong lobe that a file may hold: half a degree wide, a mirror to the eye.
constexpr double largest_exponent = 10000;

/// What a file says about a material; the rest is left to another source or to the defaults.
struct MaterialDescription {
    std::string name;
    Place place;
    std::optional<Rgb> reflectance;  ///< in [0,1]
    std::optional<Rgb> emission;     ///< luminance [cd/m2], >= 0
    std::optional<Rgb> specular;     ///< reflectance of the lobe, in [0,1]
    // Of the lobe: at most one of the two.
    std::optional<double> exponent;   ///< Phong, in [0, largest_exponent]
    std::optional<double> roughness;  ///< GGX, in [0.01, 1]
    std::optional<Sides> reflecting;
    std::optional<Sides> emitting;
};

/// Reads a Wavefront MTL file: Kd is the diffuse reflectance, Ke the emitted luminance [cd/m2], Ks
/// the reflectance of a Phong lobe, each one number (grey) or three; Ns is the lobe's exponent.
/// Lighting models without highlight (illum 0 and 1) have no lobe. Everything else is passed over;
/// textures and transparency are named in a warning, because the surfaces will look different
/// without them.
/// @throws InputError with file, line and column, also for a reflectance outside [0,1], an exponent
/// outside [0, largest_exponent] and a negative or overflowing emission.
std::vector<MaterialDescription> read_mtl(const std::string& path, std::vector<Warning>& warnings);

}  // namespace lightwell
