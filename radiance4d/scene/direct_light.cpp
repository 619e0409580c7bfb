#include "radiance4d/scene/direct_light.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "radiance4d/scene/form_factor.h"
#include "radiance4d/scene/visible_part.h"

namespace lightwell {

namespace {

/// Rounding error of the difference of two points, relative to their largest coordinate.
constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();

}  // namespace

DirectLight::DirectLight(const Scene& scene, const Visibility& visibility,
                         const OccluderTree& occluders)
    : scene_(scene), visibility_(visibility), occluders_(occluders) {
    const int count = static_cast<int>(scene.quads.size());
    LIGHTWELL_CHECK_OP(visibility.quad_count(), ==, count);
    LIGHTWELL_CHECK_OP(occluders.quad_count(), ==, count);
    for (int quad = 0; quad < count; ++quad)
        if ((scene.material_of(quad).emission > 0).any()) emitters_.push_back(quad);
}

Rgb DirectLight::irradiance(const Vec3& point, const Vec3& normal, int on_quad,
                            const std::vector<Light>& lights) const {
    Rgb sum = Rgb::Zero();
    for (const Light& light : lights)
        sum += from_light(point, normal, on_quad, light);
    for (const int emitter : emitters_)
        sum += from_emitter(point, normal, on_quad, emitter);
    return sum;
}

Rgb DirectLight::from_light(const Vec3& point, const Vec3& normal, int on_quad,
                            const Light& light) const {
    const Vec3& source = position_of(light);
    const Vec3 way = source - point;
    const double distance = way.norm();
    const double largest = std::max(point.cwiseAbs().maxCoeff(), source.cwiseAbs().maxCoeff());
    if (!(distance > rounding * largest)) return Rgb::Zero();
    const Vec3 direction = way / distance;
    const double cosine = normal.dot(direction);
    if (!(cosine > 0)) return Rgb::Zero();
    const Rgb intensity = intensity_towards(light, -direction);
    if (!(intensity > 0).any() || visibility_.occluded(point, on_quad, source, free_point))
        return Rgb::Zero();
    return intensity * (cosine / (distance * distance));
}

Rgb DirectLight::from_emitter(const Vec3& point, const Vec3& normal, int on_quad,
                              int emitter) const {
    if (emitter == on_quad) return Rgb::Zero();
    const Quad& quad = scene_.quads[static_cast<std::size_t>(emitter)].quad;
    const Material& material = scene_.material_of(emitter);
    const double height = quad.normal().dot(point - quad.centre());
    if (height < 0 && material.emitting == Sides::front) return Rgb::Zero();

    const Plane horizon{normal, normal.dot(point)};
    const ConvexPolygon target =
        clipped(ConvexPolygon(height > 0 ? quad : quad.reversed()), horizon);
    if (target.empty()) return Rgb::Zero();
    ConvexRegion between = region_between(point, target);
    between.cut(horizon);
    std::vector<int> candidates;
    occluders_.collect(between, on_quad, emitter, candidates);
    std::vector<Shadow> shadows;
    shadows.reserve(candidates.size());
    for (const int candidate : candidates)
        shadows.emplace_back(point, scene_.quads[static_cast<std::size_t>(candidate)].quad);

    // From the emitter's own plane no part is visible, and the factor stays 0.
    double factor = 0;
    for (const ConvexPolygon& piece : visible_part(point, target, std::move(shadows)))
        factor += point_form_factor(point, normal, piece);
    return material.emission * (M_PI * factor);
}

}  // namespace lightwell
