#include "solver/reference/light_walk.h"

#include <algorithm>
#include <cmath>

#include "solver/reference/sampling.h"

namespace lightwell {

namespace {

/// Highest chance to go on after a bounce: paths end even among white walls.
constexpr double longest_survival = 0.99;

/// Cosines at both ends over squared distance [1/m2]; 0 if either end faces away.
double geometry_factor(const SurfacePoint& a, const SurfacePoint& b) {
    const Vec3 way = b.position - a.position;
    const double from = way.dot(a.normal);
    const double to = -way.dot(b.normal);
    const double squared = way.squaredNorm();
    return from > 0 && to > 0 ? from * to / (squared * squared) : 0;
}

/// The balance heuristic's weight for a way of density `mine` beside one of density `other`.
double share(double mine, double other) {
    return other > 0 ? 1 / (1 + other / mine) : 1;
}

}  // namespace

PathChoices::PathChoices(std::size_t paths, RandomStream& random) : random_(random) {
    for (std::vector<Vec2>& table : tables_) {
        table.resize(paths);
        draw_even_points(table, random);
    }
}

Vec2 PathChoices::choice(int vertex, int kind) {
    if (vertex >= stratified_vertices) return random_.uniform_pair();
    return tables_[static_cast<std::size_t>(vertex * kinds + kind)][path_];
}

LightWalk::LightWalk(const Scene& scene, const Visibility& visibility,
                     const std::vector<Light>& lights)
    : scene_(scene), visibility_(visibility), lamps_(lights), emitters_(scene) {
    LIGHTWELL_CHECK_OP(static_cast<std::size_t>(visibility.quad_count()), ==, scene.quads.size());
    for (const SceneQuad& one : scene.quads)
        normals_.push_back(one.quad.normal());
}

LightWalk::Vertex LightWalk::vertex(const Vec3& origin, const Vec3& direction,
                                    const Hit& hit) const {
    const auto q = static_cast<std::size_t>(hit.quad);
    const Vec3& normal = normals_[q];
    const Material& material = scene_.material_of(hit.quad);
    Vertex result;
    // The distance has a float's precision; the plane is known to a double's.
    result.point.position = origin + hit.distance * direction;
    result.point.position -=
        normal.dot(result.point.position - scene_.quads[q].quad.vertex[0]) * normal;
    result.point.normal = hit.front ? normal : Vec3(-normal);
    result.point.quad = hit.quad;
    result.albedo = albedo_of(material, hit.front);
    result.emitted = emitted_from(material, hit.front);
    return result;
}

Rgb LightWalk::straight_from_lamps(const SurfacePoint& at, std::int64_t& rays) const {
    Rgb sum = Rgb::Zero();
    for (const LampSet::Lamp& lamp : lamps_.lamps) {
        const Vec3& position = position_of(lamp.light);
        const double factor = lamp_factor(at, position);
        if (factor == 0) continue;
        const Rgb intensity = intensity_towards(lamp.light, (at.position - position).normalized());
        if (!(intensity > 0).any()) continue;
        ++rays;
        if (!visibility_.occluded(at.position, at.quad, position, free_point))
            sum += intensity * factor;
    }
    return sum;
}

Rgb LightWalk::by_picked_emitter(const SurfacePoint& at, PathChoices& choices, int step,
                                 std::int64_t& rays) const {
    if (emitters_.empty()) return Rgb::Zero();
    Vec2 square = choices.emitter_point(step);
    const int quad = emitters_.picked(square[0]);
    const auto q = static_cast<std::size_t>(quad);
    SurfacePoint source{uniform_point_on(scene_.quads[q].quad, square), normals_[q], quad};
    const bool front = normals_[q].dot(at.position - source.position) > 0;
    if (!front) source.normal = -source.normal;
    const Rgb emitted = emitted_from(scene_.material_of(quad), front);
    const double factor = geometry_factor(at, source);
    if (quad == at.quad || factor == 0 || !(emitted > 0).any()) return Rgb::Zero();
    ++rays;
    if (visibility_.occluded(at.position, at.quad, source.position, quad)) return Rgb::Zero();
    // emitted * factor / density, times the balance weight density / (density + factor / pi),
    // arranged so that a large factor does no harm.
    return emitted / (emitters_.density(quad) / factor + 1 / M_PI);
}

Rgb LightWalk::by_lamp_ray(const SurfacePoint& at, PathChoices& choices, int step,
                           std::int64_t& rays) const {
    if (lamps_.empty()) return Rgb::Zero();
    const LampSet::Lamp& lamp = lamps_.picked(choices.plain());
    const Vec3& position = position_of(lamp.light);
    const Vec3 direction = cone_direction(lamp.axis, lamp.edge_cosine, choices.lamp_ray(step));
    ++rays;
    const Hit hit = visibility_.nearest(position, free_point, direction);
    if (!hit) return Rgb::Zero();
    const Vertex lit = vertex(position, direction, hit);
    const double factor = geometry_factor(at, lit.point);
    if (lit.point.quad == at.quad || factor == 0 || !(lit.albedo > 0).any()) return Rgb::Zero();
    ++rays;
    if (visibility_.occluded(at.position, at.quad, lit.point.position, lit.point.quad))
        return Rgb::Zero();
    const double from_lamp = lamp_factor(lit.point, position);
    const double density = lamp.pick_density * from_lamp;
    return lit.albedo / M_PI * intensity_towards(lamp.light, direction) * from_lamp /
           (density / factor + 1 / M_PI);
}

Rgb LightWalk::lamps_at_met(const SurfacePoint& met, double path_density,
                            std::int64_t& rays) const {
    Rgb sum = Rgb::Zero();
    for (const LampSet::Lamp& lamp : lamps_.lamps) {
        const Vec3& position = position_of(lamp.light);
        const double factor = lamp_factor(met, position);
        if (factor == 0) continue;
        const Rgb intensity = intensity_towards(lamp.light, (met.position - position).normalized());
        if (!(intensity > 0).any()) continue;
        ++rays;
        if (visibility_.occluded(met.position, met.quad, position, free_point)) continue;
        sum += intensity * factor * share(path_density, lamp.pick_density * factor);
    }
    return sum;
}

Rgb LightWalk::estimate(const SurfacePoint& from, LightAsked asked, int roulette_after,
                        PathChoices& choices, std::int64_t& rays) const {
    Rgb sum = Rgb::Zero();
    Rgb carried = Rgb::Ones();  // albedos so far over the chances of getting so far
    Rgb albedo = Rgb::Ones();   // of the last surface met
    SurfacePoint at = from;
    for (int step = 0;; ++step) {
        const bool emission_counts = step > 0 || asked != LightAsked::indirect;
        if (emission_counts) sum += carried * by_picked_emitter(at, choices, step, rays);
        sum += carried * by_lamp_ray(at, choices, step, rays);

        if (step > roulette_after) {
            const double survival = std::min(longest_survival, albedo.maxCoeff());
            if (choices.plain() >= survival) break;
            carried /= survival;
        }
        const Vec3 direction = cosine_direction(at.normal, choices.direction(step));
        ++rays;
        const Hit hit = visibility_.nearest(at.position, at.quad, direction);
        if (!hit) break;
        const Vertex met = vertex(at.position, direction, hit);
        const double path_density = geometry_factor(at, met.point) / M_PI;
        if (emission_counts && (met.emitted > 0).any())
            sum += carried * M_PI * met.emitted *
                   share(path_density, emitters_.density(met.point.quad));

        albedo = met.albedo;
        carried *= albedo;
        if (!(carried > 0).any()) break;
        sum += carried * lamps_at_met(met.point, path_density, rays);
        at = met.point;
    }
    return sum;
}

}  // namespace lightwell
