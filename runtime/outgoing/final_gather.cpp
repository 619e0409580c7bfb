#include "runtime/outgoing/final_gather.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <Eigen/Geometry>

#include "radiance4d/basis/direction_map.h"
#include "radiance4d/scene/brdf.h"

namespace lightwell {

namespace {

/// An orthonormal frame with the given z axis (Duff et al. 2017).
Eigen::Matrix3d frame_about(const Vec3& z) {
    const double sign = std::copysign(1.0, z[2]);
    const double a = -1 / (sign + z[2]);
    const double b = z[0] * z[1] * a;
    Eigen::Matrix3d frame;
    frame.col(0) = Vec3(1 + sign * z[0] * z[0] * a, sign * b, -sign * z[0]);
    frame.col(1) = Vec3(b, sign + z[1] * z[1] * a, -z[1]);
    frame.col(2) = z;
    return frame;
}

/// Whether a point that a ray got to, and all samples around it, are buried. Smooth light carries
/// on there, and would fill the dark gap over a panel below the ceiling; but along the foot of a
/// block, where a sample's centre may lie under it, a ray does meet lit floor.
bool is_deep_in_a_gap(const Element& element, const Vec2& uv) {
    if (element.open.empty()) return false;
    constexpr double samples_a_cell = 8;
    const CellTree& tree = element.space.tree();
    for (const int i : {0, -1, 1})
        for (const int j : {0, -1, 1}) {
            const double u = uv[0] + i / (samples_a_cell * tree.columns());
            const double v = uv[1] + j / (samples_a_cell * tree.rows());
            if (element.is_sample_open(std::clamp(u, 0.0, 1.0), std::clamp(v, 0.0, 1.0)))
                return false;
        }
    return true;
}

}  // namespace

FinalGather::FinalGather(const GlobalTransport& transport, const Visibility& visibility,
                         std::vector<SmoothSurface> incident, int strata, const GlossyLight* glossy,
                         ExactLamps exact)
    : transport_(transport),
      visibility_(visibility),
      incident_(std::move(incident)),
      glossy_(glossy),
      exact_(std::move(exact)),
      albedo_(mean_albedos(transport.scene.materials)),
      mean_(strata) {
    // One jittered point per stratum of the angular square, the same for every sensor: neighbouring
    // sensors then differ by what they see and not by chance.
    std::mt19937_64 random(20060626);
    const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    for (int i = 0; i < strata; ++i)
        for (int j = 0; j < strata; ++j) {
            const double s = (i + uniform()) / strata;
            const double t = (j + uniform()) / strata;
            square_.emplace_back(s, t);
        }
}

Rgb FinalGather::reflected(std::size_t element, const Vec3& at) const {
    const Element& met = transport_.space.element(element);
    const Vec2 uv = met.geometry.parameters(at);
    if (is_deep_in_a_gap(met, uv)) return Rgb::Zero();
    Rgb irradiance = incident_[element].at(uv[0], uv[1]);
    if (!exact_.on.empty())
        for (const Light& lamp : exact_.on[element])
            irradiance += exact_.direct->from_light(at, met.geometry.normal(), met.quad, lamp);
    return albedo_[transport_.scene.material_number(met.quad)] * irradiance;
}

Rgb FinalGather::irradiance(const Vec3& point, const Vec3& normal, int on_quad) const {
    // E = Int L cos dw = pi * mean of L over the angular square, and L = rho E_y / pi.
    const Eigen::Matrix3d frame = frame_about(normal);
    return mean_.of([&](const Vec2& square) -> Rgb {
        const Vec3 direction = frame * direction_from_square(square);
        const Hit hit = visibility_.nearest(point, on_quad, direction);
        if (!hit) return Rgb::Zero();
        const int element = transport_.space.element_on(hit.quad, hit.front);
        if (element < 0) return Rgb::Zero();
        const auto e = static_cast<std::size_t>(element);
        const Vec3 at = point + hit.distance * direction;
        if (glossy_ != nullptr && glossy_->is_glossy(e))
            return M_PI * glossy_->radiance(e, at, -direction);
        return reflected(e, at);
    });
}

GatheredRadiance FinalGather::against(const Vec3& point, int on_quad, const Vec3& direction) const {
    GatheredRadiance light;
    const Hit hit = visibility_.nearest(point, on_quad, direction);
    if (!hit) return light;
    const Material& material = transport_.scene.material_of(hit.quad);
    if (hit.front || material.emitting == Sides::both) light.emitted = material.emission;
    const int element = transport_.space.element_on(hit.quad, hit.front);
    if (element < 0 || !(hit.front || material.reflecting == Sides::both)) return light;
    const auto e = static_cast<std::size_t>(element);
    const Vec3 at = point + hit.distance * direction;
    if (glossy_ != nullptr && glossy_->is_glossy(e)) {
        light.indirect = glossy_->radiance(e, at, -direction);
        return light;
    }
    light.indirect = reflected(e, at) / M_PI;
    return light;
}

GatheredRadiance FinalGather::from_lobe(std::size_t element, const Vec3& point,
                                        const Vec3& direction) const {
    const Element& e = transport_.space.element(element);
    const Lobe& lobe = transport_.scene.material_of(e.quad).lobe;
    const Eigen::Matrix3d frame = local_frame(e.geometry);
    const Vec3 towards = frame.transpose() * direction;
    GatheredRadiance sum;
    if (!(towards[2] > 0)) return sum;
    for (const Vec2& square : square_) {
        const Vec3 from = sampled_direction(lobe, towards, square);
        if (!(from[2] > 0)) continue;
        const double weight =
            lobe_value(lobe, from, towards) * from[2] / sampling_density(lobe, towards, from);
        const GatheredRadiance light = against(point, e.quad, frame * from);
        sum.indirect += weight * light.indirect;
        sum.emitted += weight * light.emitted;
    }
    const Rgb share = lobe_reflectance(lobe) / static_cast<double>(square_.size());
    return {share * sum.indirect, share * sum.emitted};
}

}  // namespace lightwell
