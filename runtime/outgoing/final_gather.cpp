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
      direct_(exact.direct),
      spots_(lamp_spots(transport, visibility, exact.lamps)),
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
    if (!exact.lamps.empty()) near_.resize(transport.space.elements().size());
    for (const NearLamp& lamp : exact.lamps)
        for (const std::size_t e : lamp.elements)
            near_[e].push_back(lamp.light);
    spots_.erase(std::remove_if(spots_.begin(), spots_.end(),
                                [&](const LampSpot& spot) {
                                    const Element& lit = transport.space.element(spot.element);
                                    return !shines(spot.element) &&
                                           is_deep_in_a_gap(lit,
                                                            lit.geometry.parameters(spot.position));
                                }),
                 spots_.end());
}

Rgb FinalGather::brdf_of(std::size_t element, const Vec3& from, const Vec3& towards) const {
    const Element& e = transport_.space.element(element);
    if (!shines(element)) return albedo_[transport_.scene.material_number(e.quad)] / M_PI;
    const Eigen::Matrix3d frame = local_frame(e.geometry).transpose();
    return brdf(transport_.scene.material_of(e.quad), frame * from, frame * towards);
}

Rgb FinalGather::by_near_lamps(std::size_t element, const Vec3& at, const Vec3& towards,
                               double per_area) const {
    Rgb sum = Rgb::Zero();
    if (near_.empty()) return sum;
    const Element& e = transport_.space.element(element);
    const Vec3 normal = e.geometry.normal();
    for (const Light& lamp : near_[element]) {
        const double of_lamp = density_of_rays(lamp, at, normal);
        if (!(of_lamp > 0)) continue;
        const Vec3 from = (position_of(lamp) - at).normalized();
        sum += 1 / (1 + of_lamp / per_area) * brdf_of(element, from, towards) *
               direct_->from_light(at, normal, e.quad, lamp);
    }
    return sum;
}

template <typename Receives>
Rgb FinalGather::from_spots(const Vec3& point, int on_quad, const Receives& receives) const {
    Rgb sum = Rgb::Zero();
    for (const LampSpot& spot : spots_) {
        const Element& lit = transport_.space.element(spot.element);
        const Vec3 way = spot.position - point;
        const double squared = way.squaredNorm();
        if (!(squared > 0)) continue;
        const Vec3 direction = way / std::sqrt(squared);
        const double area_per_sr = -direction.dot(lit.geometry.normal()) / squared;
        if (!(area_per_sr > 0)) continue;
        const auto [made, per_sr] = receives(direction);
        if (!(made > 0) || visibility_.occluded(point, on_quad, spot.position, lit.quad)) continue;
        const double share = spot.density / (spot.density + per_sr * area_per_sr);
        sum += share * made * area_per_sr * brdf_of(spot.element, spot.to_lamp, -direction) *
               spot.flux;
    }
    return sum;
}

Rgb FinalGather::reflected(std::size_t element, const Vec3& at, const Vec3& towards) const {
    if (shines(element)) {
        Rgb light = glossy_->radiance(element, at, towards);
        if (!near_.empty() && !near_[element].empty())
            light -= glossy_->from(near_[element], element, at, towards);
        return light;
    }
    const Element& met = transport_.space.element(element);
    const Vec2 uv = met.geometry.parameters(at);
    return albedo_[transport_.scene.material_number(met.quad)] / M_PI *
           incident_[element].at(uv[0], uv[1]);
}

GatheredRadiance FinalGather::against(const Ray& ray) const {
    GatheredRadiance light;
    const Hit hit = visibility_.nearest(ray.point, ray.quad, ray.direction);
    if (!hit) return light;
    const Material& material = transport_.scene.material_of(hit.quad);
    if (hit.front || material.emitting == Sides::both) light.emitted = material.emission;
    const int element = transport_.space.element_on(hit.quad, hit.front);
    if (element < 0 || !(hit.front || material.reflecting == Sides::both)) return light;
    const auto e = static_cast<std::size_t>(element);
    const Element& met = transport_.space.element(e);
    const Vec3 at = ray.point + hit.distance * ray.direction;
    if (!shines(e) && is_deep_in_a_gap(met, met.geometry.parameters(at))) return light;
    const double area_per_sr =
        -ray.direction.dot(met.geometry.normal()) / (hit.distance * hit.distance);
    light.indirect = reflected(e, at, -ray.direction) +
                     by_near_lamps(e, at, -ray.direction, ray.per_sr * area_per_sr);
    return light;
}

Rgb FinalGather::irradiance(const Vec3& point, const Vec3& normal, int on_quad) const {
    // E = Int L cos dw = pi * mean of L over the angular square.
    const Eigen::Matrix3d frame = frame_about(normal);
    const double rays_over_pi = static_cast<double>(square_.size()) / M_PI;
    const Rgb mean = mean_.of([&](const Vec2& square) -> Rgb {
        const Vec3 local = direction_from_square(square);
        return against({point, on_quad, frame * local, rays_over_pi * local[2]}).indirect;
    });
    return M_PI * mean + from_spots(point, on_quad, [&](const Vec3& direction) {
               const double cosine = direction.dot(normal);
               return std::make_pair(cosine, rays_over_pi * cosine);
           });
}

GatheredRadiance FinalGather::from_lobe(std::size_t element, const Vec3& point,
                                        const Vec3& direction) const {
    const Element& e = transport_.space.element(element);
    const Lobe& lobe = transport_.scene.material_of(e.quad).lobe;
    const Eigen::Matrix3d frame = local_frame(e.geometry);
    const Vec3 towards = frame.transpose() * direction;
    GatheredRadiance sum;
    if (!(towards[2] > 0)) return sum;
    const auto rays = static_cast<double>(square_.size());
    for (const Vec2& square : square_) {
        const Vec3 from = sampled_direction(lobe, towards, square);
        if (!(from[2] > 0)) continue;
        const double density = sampling_density(lobe, towards, from);
        const double weight = lobe_value(lobe, from, towards) * from[2] / density;
        const GatheredRadiance light = against({point, e.quad, frame * from, rays * density});
        sum.indirect += weight / rays * light.indirect;
        sum.emitted += weight / rays * light.emitted;
    }
    sum.indirect += from_spots(point, e.quad, [&](const Vec3& way) {
        const Vec3 from = frame.transpose() * way;
        if (!(from[2] > 0)) return std::make_pair(0.0, 0.0);
        return std::make_pair(lobe_value(lobe, from, towards) * from[2],
                              rays * sampling_density(lobe, towards, from));
    });
    const Rgb share = lobe_reflectance(lobe);
    return {share * sum.indirect, share * sum.emitted};
}

}  // namespace lightwell
