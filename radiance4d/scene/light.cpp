#include "radiance4d/scene/light.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

namespace {

/// Share of the axial intensity in a direction whose cosine with the axis is given, in [0,1].
double falloff(const SpotLight& spot, double cosine) {
    const double radian = M_PI / 180;
    const double inner = std::cos(spot.inner_angle * radian);
    const double outer = std::cos(spot.outer_angle * radian);
    if (cosine >= inner) return 1;
    if (cosine <= outer) return 0;
    const double t = (cosine - outer) / (inner - outer);
    return t * t * (3 - 2 * t);
}

}  // namespace

const std::string& name_of(const Light& light) {
    return std::visit([](const auto& kind) -> const std::string& { return kind.name; }, light);
}

const Vec3& position_of(const Light& light) {
    return std::visit([](const auto& kind) -> const Vec3& { return kind.position; }, light);
}

Rgb intensity_towards(const Light& light, const Vec3& direction) {
    if (const auto* spot = std::get_if<SpotLight>(&light))
        return spot->intensity * falloff(*spot, direction.dot(spot->direction));
    return std::get<PointLight>(light).intensity;
}

}  // namespace lightwell
