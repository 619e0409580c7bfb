#include "solver/reference/random_lights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "radiance4d/basis/direction_map.h"
#include "radiance4d/scene/brdf.h"
#include "solver/reference/random_stream.h"

namespace lightwell {

namespace {

/// Axes that turn with the scene: along the sides of its largest quad, the first of those as large.
Eigen::Matrix3d own_axes(const Scene& scene) {
    constexpr double as_large = 1 - 1e-6;
    double largest = 0;
    for (const SceneQuad& one : scene.quads)
        largest = std::max(largest, one.quad.area());
    const auto found =
        std::find_if(scene.quads.begin(), scene.quads.end(),
                     [&](const SceneQuad& one) { return one.quad.area() >= as_large * largest; });
    if (found == scene.quads.end()) return Eigen::Matrix3d::Identity();
    return local_frame(found->quad);
}

bool clear_of_surfaces(const Scene& scene, const Vec3& position, double clearance) {
    return std::all_of(scene.quads.begin(), scene.quads.end(), [&](const SceneQuad& one) {
        return distance_to(one.quad, position) >= clearance;
    });
}

bool among_reflecting_sides(const Scene& scene, const Visibility& visibility, const Vec3& position,
                            const Eigen::Matrix3d& axes, const LightPlacement& placement) {
    int reflecting = 0, black_backs = 0;
    for (int k = 0; k < placement.directions; ++k) {
        const Hit hit = visibility.nearest(position, free_point,
                                           axes * spiral_direction(k, placement.directions));
        if (!hit) continue;
        const Material& material = scene.material_of(hit.quad);
        if (reflects(material) && (hit.front || material.reflecting == Sides::both)) ++reflecting;
        if (!hit.front && material.reflecting == Sides::front) ++black_backs;
    }
    return reflecting >= placement.surrounded * placement.directions &&
           black_backs <= placement.hidden * placement.directions;
}

/// Number of the space that each position belongs to, in order of first appearance.
std::vector<int> spaces_of(const std::vector<Vec3>& positions, const Visibility& visibility) {
    std::vector<int> space(positions.size(), -1);
    int spaces = 0;
    for (std::size_t first = 0; first < positions.size(); ++first) {
        if (space[first] >= 0) continue;
        std::vector<std::size_t> to_visit{first};
        space[first] = spaces;
        while (!to_visit.empty()) {
            const std::size_t here = to_visit.back();
            to_visit.pop_back();
            for (std::size_t k = first + 1; k < positions.size(); ++k)
                if (space[k] < 0 &&
                    !visibility.occluded(positions[here], free_point, positions[k], free_point)) {
                    space[k] = spaces;
                    to_visit.push_back(k);
                }
        }
        ++spaces;
    }
    return space;
}

}  // namespace

double distance_to(const Quad& quad, const Vec3& point) {
    const Vec3 normal = quad.normal();
    bool above = true;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3& start = quad.vertex[k];
        const Vec3 edge = quad.vertex[(k + 1) % 4] - start;
        const Vec3 to_point = point - start;
        if (normal.cross(edge).dot(to_point) < 0) above = false;
        const double length = edge.squaredNorm();
        const double along = length > 0 ? std::clamp(edge.dot(to_point) / length, 0.0, 1.0) : 0;
        nearest = std::min(nearest, (to_point - along * edge).norm());
    }
    return above ? std::abs(normal.dot(point - quad.vertex[0])) : nearest;
}

std::vector<PointLight> random_lights(const Scene& scene, const Visibility& visibility, int count,
                                      std::uint64_t seed, const LightPlacement& placement) {
    const Eigen::Matrix3d axes = own_axes(scene);
    Eigen::AlignedBox3d box;  // along these axes
    for (const SceneQuad& one : scene.quads)
        for (const Vec3& corner : one.quad.vertex)
            box.extend(axes.transpose() * corner);

    const int wanted = std::max(placement.candidates, 8 * count);
    const double clearance =
        placement.clearance * (scene.quads.empty() ? 0 : box.diagonal().norm());
    std::vector<Vec3> positions;
    RandomStream random(seed);
    const int most_tries = scene.quads.empty() ? 0 : 200 * wanted;
    for (int tries = 0; tries < most_tries && static_cast<int>(positions.size()) < wanted;
         ++tries) {
        // Three statements, because the order in which arguments are evaluated is open.
        const double x = random.uniform();
        const double y = random.uniform();
        const double z = random.uniform();
        const Vec3 position = axes * (box.min() + box.sizes().cwiseProduct(Vec3(x, y, z)));
        if (clear_of_surfaces(scene, position, clearance) &&
            among_reflecting_sides(scene, visibility, position, axes, placement))
            positions.push_back(position);
    }
    const std::vector<int> space = spaces_of(positions, visibility);
    std::vector<int> members(space.size(), 0);
    for (const int one : space)
        ++members[static_cast<std::size_t>(one)];
    const int largest = members.empty() ? 0 : *std::max_element(members.begin(), members.end());

    std::vector<PointLight> lights;
    for (std::size_t k = 0; k < positions.size() && static_cast<int>(lights.size()) < count; ++k)
        if (members[static_cast<std::size_t>(space[k])] >= placement.smallest_space * largest)
            lights.push_back({fmt::format("random {}", lights.size()), positions[k], Rgb::Ones()});
    if (static_cast<int>(lights.size()) < count)
        throw InputError(fmt::format(
            "{}: no room for {} lights: only {} positions lie among reflecting surfaces and at "
            "least {:.3g} m from each",
            scene.geometry_file, count, lights.size(), clearance));
    return lights;
}

std::vector<Vec3> positions_in_rooms(const Scene& scene, const Visibility& visibility, int count,
                                     std::uint64_t seed) {
    LightPlacement indoors;
    indoors.surrounded = 0.6;
    std::vector<Vec3> positions;
    for (const LightPlacement& placement : {indoors, LightPlacement{}}) {
        try {
            for (const PointLight& light : random_lights(scene, visibility, count, seed, placement))
                positions.push_back(light.position);
            break;
        } catch (const InputError&) {
            positions.clear();
        }
    }
    return positions;
}

}  // namespace lightwell
