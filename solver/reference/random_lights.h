#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/scene/scene.h"
#include "radiance4d/scene/visibility.h"

namespace lightwell {

/// How positions are proposed, evenly over the volume of the air either way.
enum class LightProposal {
    in_box,     ///< in the scene's bounding box: most are in rooms where these fill it
    on_chords,  ///< between places that see each other: whatever the rooms' share of the box
};

/// Where "anywhere in the scene" is.
struct LightPlacement {
    LightProposal proposal = LightProposal::in_box;
    /// Least distance to every quad: of positions in the box as a share of its diagonal, of those
    /// on chords as a share of the mean distance that is seen from there.
    double clearance = 0.02;
    /// Directions, even over the sphere, in which a position looks round.
    int directions = 64;
    /// Least share of them that must meet a reflecting side: keeps out of the open.
    double surrounded = 1.0 / 3;
    /// Largest share that may meet a black back: keeps out of solids whose material reflects in
    /// front only.
    double hidden = 0.05;
    /// A space is a set of positions linked by lines of sight. Spaces with fewer positions than
    /// this share of the largest one's are left dark: keeps out of closed furniture and blocks
    /// whichever way their faces point. Two closed rooms of like size are both lit.
    double smallest_space = 0.2;
    /// Positions among which spaces are told apart.
    int candidates = 512;
};

/// `count` isotropic lights of intensity (1,1,1) cd, uniform over the volume that the placement
/// allows, within the bounding box along the sides of the largest quad or on chords; the same for
/// the same seed. They turn and move with the scene.
/// @throws InputError if the scene has no such volume (or less than about 1/200 of its box, or of
///                    what chords reach).
std::vector<PointLight> random_lights(const Scene& scene, const Visibility& visibility, int count,
                                      std::uint64_t seed, const LightPlacement& placement = {});

/// `count` such positions in rooms rather than in the open, or, where there is no room, anywhere
/// that the default placement allows. Where the bounding box does not bring them, as in rooms that
/// are low for their width or far apart, those on chords are tried. None in a scene without any of
/// these, a single quad for example.
std::vector<Vec3> positions_in_rooms(const Scene& scene, const Visibility& visibility, int count,
                                     std::uint64_t seed);

/// Shortest distance from a point to a convex planar quad [m].
double distance_to(const Quad& quad, const Vec3& point);

}  // namespace lightwell
