#pragma once

#include <array>
#include <vector>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// Quads whose corners in the same place are one vertex.
struct WeldedQuads {
    double tolerance = 0;  ///< distance below which two places are the same [m]
    std::vector<Vec3> vertices;
    std::vector<std::array<int, 4>> corners;  ///< of every quad, in its order
};

/// Welds corners that lie within a millionth of the scene's diagonal: the digits that a text of
/// seven significant ones leaves.
WeldedQuads weld(const std::vector<Quad>& quads);

}  // namespace lightwell
