#pragma once

#include <string>
#include <variant>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// An isotropic point light.
struct PointLight {
    std::string name;
    Vec3 position = Vec3::Zero();  ///< [m]
    Rgb intensity = Rgb::Zero();   ///< luminous intensity [cd], the same in every direction
};

/// A point light with a cone. Intensity is full within inner_angle of the axis, nothing beyond
/// outer_angle, and falls smoothly between: with t = (cos a - cos outer) / (cos inner - cos outer),
/// by 3t^2 - 2t^3.
struct SpotLight {
    std::string name;
    Vec3 position = Vec3::Zero();     ///< [m]
    Rgb intensity = Rgb::Zero();      ///< luminous intensity on the axis [cd]
    Vec3 direction = -Vec3::UnitZ();  ///< axis, unit length
    double inner_angle = 20;  ///< half-angle of full intensity [degrees], 0 <= inner <= outer
    double outer_angle = 30;  ///< half-angle where the light ends [degrees], inner <= outer <= 180
};

/// Every kind of light that is placed in a scene. (Emitting quads are materials, see
/// Material::emission.)
using Light = std::variant<PointLight, SpotLight>;

const std::string& name_of(const Light& light);
const Vec3& position_of(const Light& light);
/// Luminous intensity towards a unit direction, away from the light [cd].
Rgb intensity_towards(const Light& light, const Vec3& direction);

}  // namespace lightwell
