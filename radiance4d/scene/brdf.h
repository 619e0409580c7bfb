#pragma once

#include <vector>

#include "radiance4d/scene/material.h"

namespace lightwell {

// What materials do to light. Directions are unit vectors in a frame whose z axis is the normal of
// the side and point away from it, z >= 0. That a side does not reflect (Material::reflecting) is
// for the caller to know.

/// Whether the material has a lobe that reflects anything.
bool is_glossy(const Material& material);
/// Whether it reflects anything at all.
bool reflects(const Material& material);

/// Reflectance of the lobe; zero without one.
Rgb lobe_reflectance(const Lobe& lobe);
/// The BRDF of the lobe without its reflectance [1/sr].
double lobe_value(const Lobe& lobe, const Vec3& in, const Vec3& out);
/// Albedo of the lobe without its reflectance towards directions of this cosine, in [0,1].
double lobe_albedo(const Lobe& lobe, double cosine);
/// Int f^2 cos dw of the lobe without its reflectance, given a direction of this cosine [1/sr].
double lobe_square(const Lobe& lobe, double cosine);
/// A direction drawn nearly in proportion to the lobe times the cosine, given the other direction;
/// z < 0 where the lobe reaches below the surface. There must be a lobe.
Vec3 sampled_direction(const Lobe& lobe, const Vec3& given, const Vec2& square);
/// The density of sampled_direction [1/sr].
double sampling_density(const Lobe& lobe, const Vec3& given, const Vec3& sampled);

/// The whole BRDF f = rho/pi + lobe [1/sr], symmetric (Helmholtz).
Rgb brdf(const Material& material, const Vec3& in, const Vec3& out);
/// The directional albedo a(theta) = Int f cos dw: the share of light from a direction of this
/// cosine that is reflected, and by symmetry the share of uniform light that is reflected there.
Rgb albedo(const Material& material, double cosine);
/// The mean of a(theta) over the hemisphere, cosine-weighted: the share of uniform light that is
/// reflected in all; exactly the reflectance of a diffuse material. A quadrature: call it once per
/// material.
Rgb mean_albedo(const Material& material);

/// The mean albedo of every material.
std::vector<Rgb> mean_albedos(const std::vector<Material>& materials);
/// A diffuse material of the same mean albedo, which is the material itself if it is diffuse.
Material diffuse_of_equal_albedo(const Material& material);

/// Where a material reflects the largest share.
struct AlbedoPeak {
    double angle = 0;   ///< from the normal [degrees]
    int channel = 0;    ///< 0 red, 1 green, 2 blue
    double albedo = 0;  ///< a(angle) there
};

/// The largest a(theta) over all angles and channels: the material's albedo bound, which bounds the
/// norm of reflection (Arvo 1995).
AlbedoPeak albedo_peak(const Material& material);
/// The material with diffuse part and lobe scaled alike so that the peak is at most `most`.
Material scaled_to_albedo(const Material& material, double most);

}  // namespace lightwell
