#pragma once

#include <vector>

#include "solver/reading/welded_quads.h"

namespace lightwell {

/// Side i of a quad runs from its corner i to the next one.
struct QuadSide {
    int quad = 0;
    int side = 0;
};

/// How quads hang together by the sides they share.
struct SurfaceMesh {
    /// Quads that face against most of their surface, where a surface is what hangs together by
    /// sides of exactly two quads. Of two halves, the one with the lowest quad is right.
    std::vector<bool> flipped;
    /// Sides that no other quad shares, in the order of their quads.
    std::vector<QuadSide> open_sides;
    int many_quad_sides = 0;  ///< sides that more than two quads share
    int surfaces = 0;         ///< pieces that hang together
    int closed_surfaces = 0;  ///< those of them without an open side
};

/// Builds the half-edge mesh of the quads but for those left out. The mesh is given surfaces only:
/// quads are turned to face the same way first, sides of more than two quads are left unjoined, and
/// a vertex at which several fans of quads meet becomes one vertex for each fan.
SurfaceMesh surface_mesh(const WeldedQuads& quads, const std::vector<bool>& left_out);

}  // namespace lightwell
