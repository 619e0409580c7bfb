#pragma once

#include <string>
#include <vector>

#include "radiance4d/operator/space_chunk.h"
#include "radiance4d/operator/transport_operator.h"
#include "radiance4d/scene/dimmed_light.h"
#include "radiance4d/scene/scene.h"

namespace lightwell {

/// Most levels of a tree in the file: CellTree holds no more than 2^28 cells.
constexpr int most_levels = 28;

// What an operator file may hold. Each says in words what is wrong, and nothing when all is well;
// the writer asks the same questions as the reader, so that what is written can be read.

/// Materials (reflectance in [0,1], emission finite and >= 0) and quads (coordinates finite).
std::string flaw_of_surfaces(const Scene& scene);
/// Lights, camera and sensor grids.
std::string flaw_of_surroundings(const Scene& scene);
/// Lights of a scene before they are dimmed: sane, and as many and as bright as the scene has them.
std::string flaw_of_dimmers(const std::vector<DimmedLight>& lights, const Scene& scene);
/// Elements: each side of a quad at most once; quads planar to 1e-3 of their size, strictly convex;
/// trees no finer than 2^28 cells, all together less than 2^32 functions.
std::string flaw_of_space(const std::vector<ElementShape>& shapes, const Scene& scene);
/// Operator over `functions` basis functions: rows ascending and in range, values finite; of a
/// symmetric operator only the upper half.
std::string flaw_of_operator(const TransportOperator& operator_, std::uint64_t functions,
                             bool upper_half);

}  // namespace lightwell
