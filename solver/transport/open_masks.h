#pragma once

#include <vector>

#include "radiance4d/basis/radiance_space.h"
#include "radiance4d/scene/occluder_tree.h"
#include "radiance4d/scene/visibility.h"
#include "solver/transport/oracle.h"

namespace lightwell {

/// Finds the finest cells that are partly buried and sets their masks: under the foot of a block,
/// behind a picture on a wall, above a lamp that almost touches the ceiling. A sample is open if
/// enough of a few rays over its hemisphere escape, or meet another element that is not a parallel
/// one at a fraction of the cell's size. Cells are first looked at in their corners and centre;
/// only those that disagree are sampled in full.
///
/// Of quads that lie in one plane and overlap, the first in the scene is the one that light meets,
/// as it would be with a ray; the others are buried under it. Otherwise the light on the overlap
/// would count twice.
void set_open_masks(const std::vector<Quad>& quads, const OccluderTree& tree,
                    const Visibility& visibility, std::vector<Element>& elements, OracleCost& cost);

}  // namespace lightwell
