#include "solver/ground.h"

#include <algorithm>
#include <utility>

#include "radiance4d/scene/scene_quads.h"
#include "solver/reference/random_lights.h"
#include "solver/transport/elements.h"
#include "solver/transport/survey.h"

namespace lightwell {

Ground::Ground(const Scene& the_scene, OracleCost& cost, SceneLobes known)
    : scene(the_scene),
      lobes(known.empty() ? lobes_of(the_scene.materials) : std::move(known)),
      quads(quads_of(the_scene)),
      visibility(quads),
      occluders(quads) {
    constexpr int survey_rays = 256;
    constexpr int least_in_rooms = 48, most_in_rooms = 400, elements_a_light = 8;
    // Weights that 48 lamps give to fine functions are mostly noise: 256 leave out 10 to 40 % more
    // coefficients at an equal error (cornell-box, maze, office, furnace), 2048 hardly more.
    constexpr int least_expected = 256;
    constexpr int trials = 16;
    elements = seeing_elements(scene, blind_sides);
    std::vector<SideSurvey> sides = survey_sides(elements, visibility, survey_rays, cost);
    // Every room of a large building should see some of the lights.
    const int lights = std::clamp(static_cast<int>(elements.size()) / elements_a_light,
                                  least_in_rooms, most_in_rooms);
    expected = positions_in_rooms(scene, visibility, std::max(lights, least_expected), 20060626);
    in_rooms = {expected.begin(),
                expected.begin() + std::min(lights, static_cast<int>(expected.size()))};
    tried = positions_in_rooms(scene, visibility, trials, 1992);
    inside_of_solids = drop_inside_of_solids(quads, in_rooms, visibility, cost, elements, sides);
    for (const SideSurvey& side : sides)
        closed.push_back(side.escaped == 0);
    distance = typical_distance(elements, sides);
    for (const Element& element : elements)
        area += element.area();
    // No error asks for wider cells than this share of the distance.
    constexpr double widest_cells = 0.2;
    gaps = gaps_between(elements, widest_cells * distance);
}

}  // namespace lightwell
