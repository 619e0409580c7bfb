#pragma once

#include <vector>

#include "radiance4d/basis/radiance_space.h"
#include "solver/transport/survey.h"

namespace lightwell {

/// One element, not refined yet, for each side of a quad that reflects or emits and that has
/// something in front of it. A side from which no other quad can be seen is dropped at once and
/// costs nothing.
///
/// @param blind  receives the number of sides dropped
std::vector<Element> seeing_elements(const Scene& scene, std::uint64_t& blind);

/// Drops the backs that lie inside solids: nothing escapes from them, they meet backs as well, none
/// of the places where a light can be sees them, and no light comes to them, as it would through a
/// gap in a wall. Without light they cost links, and darken what they stand on. A box may lack the
/// bottom that it stands on: from its lid most of what is met is a floor then. Where some light
/// comes into such a cavity, all of its sides stay. The survey loses the same entries.
///
/// @param quads      of the scene
/// @param positions  where lights can be
/// @return the number of sides dropped
std::uint64_t drop_inside_of_solids(const std::vector<Quad>& quads,
                                    const std::vector<Vec3>& positions,
                                    const Visibility& visibility, OracleCost& cost,
                                    std::vector<Element>& elements,
                                    std::vector<SideSurvey>& survey);

/// Gives an element its cells, at most `cell_size` [m] along either side of the quad, at most
/// `most_levels` levels.
void set_cells(Element& element, double cell_size, int most_levels);
/// The same for every element.
void set_cells(std::vector<Element>& elements, double cell_size, int most_levels);

/// The distance that light typically travels between surfaces [m]: the median over all area of
/// SideSurvey::distance.
double typical_distance(const std::vector<Element>& elements,
                        const std::vector<SideSurvey>& survey);

}  // namespace lightwell
