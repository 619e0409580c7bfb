#include "solver/reference/surface_points.h"

#include <cmath>
#include <cstddef>

#include "radiance4d/scene/brdf.h"
#include "solver/reference/random_stream.h"
#include "solver/reference/sampling.h"

namespace lightwell {

namespace {

const SceneQuad& quad_at(const Scene& scene, int quad) {
    return scene.quads[static_cast<std::size_t>(quad)];
}

Vec3 normal_of(const Quad& quad, bool front) {
    return front ? quad.normal() : Vec3(-quad.normal());
}

bool sees_anything(const Quad& quad, const QuadSide& side, const Visibility& visibility, int rays,
                   RandomStream& random) {
    std::vector<Vec2> places(static_cast<std::size_t>(rays));
    std::vector<Vec2> directions(places.size());
    draw_even_points(places, random);
    draw_even_points(directions, random);
    const Vec3 normal = normal_of(quad, side.front);
    for (std::size_t k = 0; k < places.size(); ++k)
        if (visibility.nearest(uniform_point_on(quad, places[k]), side.quad,
                               cosine_direction(normal, directions[k])))
            return true;
    return false;
}

}  // namespace

std::vector<QuadSide> seeing_sides(const Scene& scene, const Visibility& visibility, int rays,
                                   std::uint64_t seed) {
    std::vector<QuadSide> sides;
    for (int q = 0; q < static_cast<int>(scene.quads.size()); ++q) {
        const Material& material = scene.material_of(q);
        if (!reflects(material)) continue;
        for (const bool front : {true, false}) {
            if (!front && material.reflecting == Sides::front) continue;
            const QuadSide side{q, front};
            RandomStream random(seed, static_cast<std::uint64_t>(q), front ? 1 : 0);
            if (sees_anything(quad_at(scene, q).quad, side, visibility, rays, random))
                sides.push_back(side);
        }
    }
    return sides;
}

std::vector<SurfacePoint> sample_surface(const Scene& scene, const std::vector<QuadSide>& sides,
                                         int count, std::uint64_t seed) {
    double whole = 0;
    for (const QuadSide& side : sides)
        whole += quad_at(scene, side.quad).quad.area();
    if (!(whole > 0))
        throw InputError(scene.geometry_file + ": no surface to place points on (" +
                         std::to_string(sides.size()) + " sides)");

    // One random offset decides how many points each side gets (never more than one from its share
    // of the area); on a side they follow a lattice of two irrational steps (the plastic number's),
    // randomly shifted.
    const double plastic = 1.32471795724474602596;
    const double offset = RandomStream(seed).uniform();
    std::vector<SurfacePoint> points;
    points.reserve(static_cast<std::size_t>(count));
    double covered = 0;
    for (std::size_t k = 0; k < sides.size(); ++k) {
        const QuadSide& side = sides[k];
        const Quad& quad = quad_at(scene, side.quad).quad;
        covered += quad.area();
        const bool last = k + 1 == sides.size();
        const double due = last ? count : count * (covered / whole) - offset;
        const Vec3 normal = normal_of(quad, side.front);
        Vec2 place = RandomStream(seed, k + 1).uniform_pair();
        while (static_cast<double>(points.size()) < due) {
            points.push_back({uniform_point_on(quad, place), normal, side.quad});
            place += Vec2(1 / plastic, 1 / (plastic * plastic));
            place -= Vec2(std::floor(place[0]), std::floor(place[1]));
        }
    }
    return points;
}

}  // namespace lightwell
