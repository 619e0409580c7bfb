#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/basis/angular_reflection.h"
#include "radiance4d/basis/radiance_space.h"
#include "radiance4d/scene/occluder_tree.h"
#include "radiance4d/scene/scene.h"
#include "radiance4d/scene/visibility.h"
#include "solver/transport/gaps.h"
#include "solver/transport/oracle.h"

namespace lightwell {

/// What a precomputation stands on, whatever the settings: who can be seen, which sides take part,
/// and where lights can be.
struct Ground {
    /// Surveys the scene, which must outlive the object.
    ///
    /// @param cost   receives the rays
    /// @param known  lobes of the scene, as far as they are computed already; empty: none is
    Ground(const Scene& the_scene, OracleCost& cost, SceneLobes known = {});

    const Scene& scene;
    SceneLobes lobes;  ///< by material
    std::vector<Quad> quads;
    Visibility visibility;
    OccluderTree occluders;
    std::vector<Element> elements;  ///< sides that see something and lie in no solid; not refined
    std::vector<bool> closed;       ///< by element: nothing escapes from it
    double distance = 0;            ///< that light typically travels [m]
    double area = 0;                ///< of all elements, what is buried of them included [m2]
    std::vector<Gap> gaps;          ///< between elements, as low as cells may be wide
    /// Places in rooms, both groups independent of each other: where lights are expected, and where
    /// left-out coefficients are tried. A scene without room for a light, a single quad for
    /// example, has none.
    std::vector<Vec3> expected, tried;
    /// Whether there are lights to tell what may be left out; without them nothing is.
    bool tells_what_matters() const { return !expected.empty() && !tried.empty(); }
    std::vector<Vec3> in_rooms;  ///< the first of `expected`: as many as it takes to see each room
    std::uint64_t blind_sides = 0;       ///< sides dropped because they see no other side
    std::uint64_t inside_of_solids = 0;  ///< backs dropped because they lie inside solids
};

}  // namespace lightwell
