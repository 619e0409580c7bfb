#include "solver/reference/radiance_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "radiance4d/scene/brdf.h"
#include "solver/reference/sampling.h"

namespace lightwell {

namespace {

/// Highest chance to go on after a bounce: paths end even among white walls.
constexpr double longest_survival = 0.99;

/// Cells of the tables of albedo over the cosine.
constexpr int albedo_cells = 256;

/// The balance heuristic's weight for a way of density `mine` beside one of density `other`.
double share(double mine, double other) {
    return other > 0 ? 1 / (1 + other / mine) : 1;
}

Eigen::Matrix3d frame_about(const Vec3& normal) {
    Eigen::Matrix3d frame;
    const Vec3 across = normal.unitOrthogonal();
    frame << across, normal.cross(across), normal;
    return frame;
}

/// Area density [1/m2] at a point seen from `from` per solid-angle density [1/sr] of the direction.
double area_per_angle(const Vec3& from, const SurfacePoint& to) {
    const Vec3 way = to.position - from;
    const double squared = way.squaredNorm();
    return std::max(0.0, -way.dot(to.normal)) / (squared * std::sqrt(squared));
}

}  // namespace

RadianceWalk::RadianceWalk(const Scene& scene, const Visibility& visibility,
                           const std::vector<Light>& lights, EmissionLaw law)
    : scene_(scene), visibility_(visibility), lamps_(lights), emitters_(scene), law_(law) {
    LIGHTWELL_CHECK_OP(static_cast<std::size_t>(visibility.quad_count()), ==, scene.quads.size());
    for (const SceneQuad& one : scene.quads)
        normals_.push_back(one.quad.normal());
    if (law_ == EmissionLaw::as_stated) return;
    for (const Material& material : scene.materials) {
        albedo_.emplace_back();
        for (int k = 0; k <= albedo_cells; ++k)
            albedo_.back().push_back(albedo(material, k / double{albedo_cells}));
    }
}

Rgb RadianceWalk::emitted(int quad, bool front, double cosine) const {
    const Rgb stated = emitted_from(scene_.material_of(quad), front);
    if (law_ == EmissionLaw::as_stated || !(stated > 0).any()) return stated;
    const std::vector<Rgb>& table = albedo_[scene_.material_number(quad)];
    const double at = std::clamp(cosine, 0.0, 1.0) * albedo_cells;
    const auto cell = std::min(static_cast<std::size_t>(at), std::size_t{albedo_cells - 1});
    const double rest = at - static_cast<double>(cell);
    return stated * (1 - ((1 - rest) * table[cell] + rest * table[cell + 1]));
}

RadianceWalk::Vertex RadianceWalk::sensor(const SurfacePoint& at) const {
    Vertex result;
    result.point = at;
    result.frame = frame_about(at.normal);
    return result;
}

RadianceWalk::Vertex RadianceWalk::vertex(const Vec3& origin, const Vec3& direction,
                                          const Hit& hit) const {
    const auto q = static_cast<std::size_t>(hit.quad);
    const Vec3& normal = normals_[q];
    Vertex result;
    // The distance has a float's precision; the plane is known to a double's.
    result.point.position = origin + hit.distance * direction;
    result.point.position -=
        normal.dot(result.point.position - scene_.quads[q].quad.vertex[0]) * normal;
    result.point.normal = hit.front ? normal : Vec3(-normal);
    result.point.quad = hit.quad;
    result.frame = frame_about(result.point.normal);
    result.material = &scene_.material_of(hit.quad);
    result.back = result.frame.transpose() * (-direction);
    result.reflecting =
        reflects(*result.material) && (hit.front || result.material->reflecting == Sides::both);
    result.emitted = emitted(hit.quad, hit.front, result.back[2]);
    return result;
}

Rgb RadianceWalk::response(const Vertex& at, const Vec3& direction) {
    if (!(direction[2] > 0)) return Rgb::Zero();
    if (at.material == nullptr) return Rgb::Constant(direction[2]);
    return direction[2] * brdf(*at.material, at.back, direction);
}

double RadianceWalk::lobe_share(const Vertex& at) {
    if (at.material == nullptr) return 0;
    const double lobe = lobe_reflectance(at.material->lobe).maxCoeff();
    return lobe > 0 ? lobe / (lobe + at.material->reflectance.maxCoeff()) : 0;
}

Vec3 RadianceWalk::drawn_direction(const Vertex& at, Vec2 square) {
    const double lobe = lobe_share(at);
    if (square[0] < lobe) {
        square[0] /= lobe;
        return sampled_direction(at.material->lobe, at.back, square);
    }
    square[0] = (square[0] - lobe) / (1 - lobe);
    return cosine_direction(Vec3::UnitZ(), square);
}

double RadianceWalk::density(const Vertex& at, const Vec3& direction) {
    const double lobe = lobe_share(at);
    const double of_cosine = (1 - lobe) * std::max(0.0, direction[2]) / M_PI;
    return lobe > 0 ? of_cosine + lobe * sampling_density(at.material->lobe, at.back, direction)
                    : of_cosine;
}

Rgb RadianceWalk::by_picked_emitter(const Vertex& at, PathChoices& choices, int step,
                                    std::int64_t& rays) const {
    if (emitters_.empty()) return Rgb::Zero();
    Vec2 square = choices.emitter_point(step);
    const int quad = emitters_.picked(square[0]);
    const auto q = static_cast<std::size_t>(quad);
    if (quad == at.point.quad) return Rgb::Zero();
    SurfacePoint source{uniform_point_on(scene_.quads[q].quad, square), normals_[q], quad};
    const Vec3 way = (source.position - at.point.position).normalized();
    const bool front = normals_[q].dot(way) < 0;
    if (!front) source.normal = -source.normal;
    const Vec3 direction = at.frame.transpose() * way;
    const Rgb light = emitted(quad, front, -source.normal.dot(way)) * response(at, direction);
    const double per_angle = area_per_angle(at.point.position, source);
    if (!(light > 0).any() || per_angle == 0) return Rgb::Zero();
    ++rays;
    if (visibility_.occluded(at.point.position, at.point.quad, source.position, quad))
        return Rgb::Zero();
    // light * per_angle / (sum of both densities), arranged so that a large per_angle does no harm.
    return light / (emitters_.density(quad) / per_angle + density(at, direction));
}

Rgb RadianceWalk::by_lamp_ray(const Vertex& at, PathChoices& choices, int step,
                              std::int64_t& rays) const {
    if (lamps_.empty()) return Rgb::Zero();
    const LampSet::Lamp& lamp = lamps_.picked(choices.plain());
    const Vec3& position = position_of(lamp.light);
    const Vec3 from_lamp = cone_direction(lamp.axis, lamp.edge_cosine, choices.lamp_ray(step));
    ++rays;
    const Hit hit = visibility_.nearest(position, free_point, from_lamp);
    if (!hit) return Rgb::Zero();
    Vertex lit = vertex(position, from_lamp, hit);
    const double per_angle = area_per_angle(at.point.position, lit.point);
    if (lit.point.quad == at.point.quad || per_angle == 0 || !lit.reflecting) return Rgb::Zero();
    const Vec3 way = (lit.point.position - at.point.position).normalized();
    const Vec3 direction = at.frame.transpose() * way;
    const Vec3 to_lamp = lit.back;
    lit.back = lit.frame.transpose() * (-way);
    const double lamp_area = lamp_factor(lit.point, position);
    if (!(direction[2] > 0) || lamp_area == 0) return Rgb::Zero();
    ++rays;
    if (visibility_.occluded(at.point.position, at.point.quad, lit.point.position, lit.point.quad))
        return Rgb::Zero();
    // The lamp's cosine is in lamp_area, so the BRDF stands alone.
    const Rgb reflected = brdf(*lit.material, lit.back, to_lamp) *
                          intensity_towards(lamp.light, from_lamp) * lamp_area;
    return response(at, direction) * reflected /
           (lamp.pick_density * lamp_area / per_angle + density(at, direction));
}

Rgb RadianceWalk::from_lamps(const Vertex& at, double path_density, std::int64_t& rays) const {
    Rgb sum = Rgb::Zero();
    for (const LampSet::Lamp& lamp : lamps_.lamps) {
        const Vec3& position = position_of(lamp.light);
        const double lamp_area = lamp_factor(at.point, position);
        if (lamp_area == 0) continue;
        const Vec3 to_lamp = (position - at.point.position).normalized();
        const Rgb intensity = intensity_towards(lamp.light, -to_lamp);
        const Rgb f = brdf(*at.material, at.back, at.frame.transpose() * to_lamp);
        if (!((f * intensity) > 0).any()) continue;
        ++rays;
        if (visibility_.occluded(at.point.position, at.point.quad, position, free_point)) continue;
        sum += f * intensity * lamp_area * share(path_density, lamp.pick_density * lamp_area);
    }
    return sum;
}

Rgb RadianceWalk::walk(Vertex at, LightAsked asked, int roulette_after, PathChoices& choices,
                       std::int64_t& rays) const {
    Rgb sum = Rgb::Zero();
    Rgb carried = Rgb::Ones();  // responses so far over the densities of the directions taken
    for (int step = 0;; ++step) {
        const bool emission_counts = step > 0 || asked != LightAsked::indirect;
        if (emission_counts) sum += carried * by_picked_emitter(at, choices, step, rays);
        sum += carried * by_lamp_ray(at, choices, step, rays);

        if (step > roulette_after) {
            const Rgb most = at.material->reflectance + lobe_reflectance(at.material->lobe);
            const double survival = std::min(longest_survival, most.maxCoeff());
            if (choices.plain() >= survival) break;
            carried /= survival;
        }
        const Vec3 local = drawn_direction(at, choices.direction(step));
        const double per_angle = density(at, local);
        if (!(local[2] > 0) || !(per_angle > 0)) break;
        const Vec3 direction = at.frame * local;
        ++rays;
        const Hit hit = visibility_.nearest(at.point.position, at.point.quad, direction);
        if (!hit) break;
        const Vertex met = vertex(at.point.position, direction, hit);
        carried *= response(at, local) / per_angle;
        const double per_area = per_angle * area_per_angle(at.point.position, met.point);
        if (emission_counts && (met.emitted > 0).any())
            sum += carried * met.emitted * share(per_area, emitters_.density(met.point.quad));
        if (!met.reflecting || !(carried > 0).any()) break;
        sum += carried * from_lamps(met, per_area, rays);
        at = met;
    }
    return sum;
}

Rgb RadianceWalk::irradiance(const SurfacePoint& from, LightAsked asked, int roulette_after,
                             PathChoices& choices, std::int64_t& rays) const {
    return walk(sensor(from), asked, roulette_after, choices, rays);
}

Rgb RadianceWalk::radiance(const RadianceProbe& probe, LightAsked asked, int roulette_after,
                           PathChoices& choices, std::int64_t& rays) const {
    ++rays;
    const Hit hit = visibility_.nearest(probe.position, free_point, probe.direction);
    if (!hit) return Rgb::Zero();
    const Vertex seen = vertex(probe.position, probe.direction, hit);
    Rgb sum = Rgb::Zero();
    if (seen.reflecting) sum += walk(seen, asked, roulette_after, choices, rays);
    if (asked == LightAsked::indirect) return sum;
    constexpr double only_way = std::numeric_limits<double>::infinity();
    if (seen.reflecting) sum += from_lamps(seen, only_way, rays);
    return sum + seen.emitted;
}

}  // namespace lightwell
