#include "solver/reference/random_lights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

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

/// What is seen all round from a position.
struct Surroundings {
    int reflecting = 0, black_backs = 0;  ///< directions that meet such a side
    double distance = 0;                  ///< mean, of what is met [m]
};

Surroundings looked_round(const Scene& scene, const Visibility& visibility, const Vec3& position,
                          const Eigen::Matrix3d& axes, int directions) {
    Surroundings seen;
    int met = 0;
    for (int k = 0; k < directions; ++k) {
        const Hit hit =
            visibility.nearest(position, free_point, axes * spiral_direction(k, directions));
        if (!hit) continue;
        const Material& material = scene.material_of(hit.quad);
        if (reflects(material) && (hit.front || material.reflecting == Sides::both))
            ++seen.reflecting;
        if (!hit.front && material.reflecting == Sides::front) ++seen.black_backs;
        seen.distance += (hit.distance - seen.distance) / ++met;
    }
    return seen;
}

bool is_among_reflecting_sides(const Surroundings& seen, const LightPlacement& placement) {
    return seen.reflecting >= placement.surrounded * placement.directions &&
           seen.black_backs <= placement.hidden * placement.directions;
}

/// Proposes positions in the bounding box along given axes.
class BoxProposals {
  public:
    BoxProposals(const Scene& scene, const Eigen::Matrix3d& axes) : axes_(axes) {
        for (const SceneQuad& one : scene.quads)
            for (const Vec3& corner : one.quad.vertex)
                box_.extend(axes.transpose() * corner);
    }

    double diagonal() const { return box_.diagonal().norm(); }

    Vec3 next(RandomStream& random) const {
        // Three statements, because the order in which arguments are evaluated is open.
        const double x = random.uniform();
        const double y = random.uniform();
        const double z = random.uniform();
        return axes_ * (box_.min() + box_.sizes().cwiseProduct(Vec3(x, y, z)));
    }

  private:
    Eigen::Matrix3d axes_;
    Eigen::AlignedBox3d box_;  // along these axes
};

/// Proposes positions on chords: a surface point even by area, a direction by its cosine, a place
/// anywhere on the way to what is met. Such chords are as dense everywhere in the air, whichever
/// way they run, so that places on them are even over its volume where long ones are kept oftener
/// than short ones, by their lengths.
class ChordProposals {
  public:
    ChordProposals(const Scene& scene, const Visibility& visibility, RandomStream& random)
        : scene_(scene), visibility_(visibility) {
        double area = 0;
        for (const SceneQuad& one : scene.quads)
            area_to_.push_back(area += one.quad.area());
        constexpr int pilots = 512;
        for (int k = 0; k < pilots; ++k)
            longest_ = std::max(longest_, chord(random).length);
    }

    /// None where a chord leaves the scene or is too short for its turn.
    std::optional<Vec3> next(RandomStream& random) const {
        const Chord found = chord(random);
        const double kept = random.uniform(), at = random.uniform();
        if (!(kept * longest_ < found.length)) return std::nullopt;
        return found.start + at * found.length * found.direction;
    }

  private:
    struct Chord {
        Vec3 start, direction;
        double length = 0;  ///< 0: it leaves the scene
    };

    Chord chord(RandomStream& random) const {
        const double area = random.uniform() * area_to_.back();
        const auto at = std::upper_bound(area_to_.begin(), area_to_.end() - 1, area);
        const auto q = static_cast<int>(at - area_to_.begin());
        const Quad& quad = scene_.quads[static_cast<std::size_t>(q)].quad;
        const double u = random.uniform(), v = random.uniform();
        const double side = random.uniform() < 0.5 ? 1 : -1;
        const double sine_square = random.uniform(), turn = 2 * M_PI * random.uniform();
        const double sine = std::sqrt(sine_square);
        Chord chord;
        chord.start = quad.point(u, v);
        chord.direction = local_frame(quad) * Vec3(sine * std::cos(turn), sine * std::sin(turn),
                                                   side * std::sqrt(1 - sine_square));
        const Hit hit = visibility_.nearest(chord.start, q, chord.direction);
        if (hit) chord.length = hit.distance;
        return chord;
    }

    const Scene& scene_;
    const Visibility& visibility_;
    std::vector<double> area_to_;  ///< of all quads up to each
    double longest_ = 0;           ///< of some chords: longer ones are rare
};

/// Positions that the placement allows, as many as wanted if that can be had.
std::vector<Vec3> allowed_positions(const Scene& scene, const Visibility& visibility, int wanted,
                                    RandomStream& random, const LightPlacement& placement) {
    std::vector<Vec3> positions;
    if (scene.quads.empty()) return positions;
    const Eigen::Matrix3d axes = own_axes(scene);
    const BoxProposals box(scene, axes);
    const bool on_chords = placement.proposal == LightProposal::on_chords;
    std::optional<ChordProposals> chords;
    if (on_chords) chords.emplace(scene, visibility, random);
    constexpr int tries_for_one = 200;
    for (int tries = 0;
         static_cast<int>(positions.size()) < wanted && tries < tries_for_one * wanted; ++tries) {
        // That far below one in so many chance does not bring it.
        const auto found = static_cast<double>(positions.size());
        if (tries > tries_for_one * (found + 4 * std::sqrt(found) + 16)) break;
        const std::optional<Vec3> position =
            on_chords ? chords->next(random) : std::optional<Vec3>(box.next(random));
        if (!position) continue;
        const double in_box = placement.clearance * box.diagonal();
        if (!on_chords && !clear_of_surfaces(scene, *position, in_box)) continue;
        const Surroundings seen =
            looked_round(scene, visibility, *position, axes, placement.directions);
        if (is_among_reflecting_sides(seen, placement) &&
            (!on_chords ||
             clear_of_surfaces(scene, *position, placement.clearance * seen.distance)))
            positions.push_back(*position);
    }
    return positions;
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
    RandomStream random(seed);
    const std::vector<Vec3> positions = allowed_positions(
        scene, visibility, std::max(placement.candidates, 8 * count), random, placement);
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
            "{}: no room for {} lights: only {} positions lie among reflecting surfaces and not "
            "close to any",
            scene.geometry_file, count, lights.size()));
    return lights;
}

std::vector<Vec3> positions_in_rooms(const Scene& scene, const Visibility& visibility, int count,
                                     std::uint64_t seed) {
    LightPlacement indoors, indoors_on_chords, on_chords;
    indoors.surrounded = indoors_on_chords.surrounded = 0.6;
    indoors_on_chords.proposal = on_chords.proposal = LightProposal::on_chords;
    indoors_on_chords.clearance = on_chords.clearance = 0.07;  // in a room, as far as of its box
    std::vector<Vec3> positions;
    for (const LightPlacement& placement :
         {indoors, LightPlacement{}, indoors_on_chords, on_chords}) {
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
