#pragma once

#include <vector>

#include "radiance4d/scene/scene.h"
#include "solver/reading/reading_report.h"

namespace lightwell {

/// When a quad is cut along what stands on it.
struct WallCutRule {
    /// Least area of a quad that is cut, as a share of the area of all quads. What leaks across a
    /// smaller one is little against the error that is asked for, an average over all surfaces,
    /// and pieces cost time: a desk on two panels need not be cut along them.
    double least_area = 0.02;
    /// Least share of the first cut's length that walls stand on, in (0,1]. Where walls stand on
    /// half of it, the openings between two spaces are no wider than the wall between them; below
    /// half, it is a thing that stands in one space, as a block or a bed does, and the light on
    /// both sides of it is much the same.
    double least_cover = 0.5;
    /// The same for the further cuts of a quad, which is then known to lie under walls. Some of
    /// them must do with less: rooms in a corner of a hall do not divide it from side to side. In
    /// a hospital's floor of sixty rooms, half of the length left a quarter of the walls, a quarter
    /// left 4 %, and a fifth left none.
    double least_cover_of_pieces = 0.2;
    /// Least side of a piece, as a share of the quad's longest diagonal, in (0,0.5). Walls within
    /// it of one line count as standing on that line.
    double least_side = 5e-4;
    /// How much more a piece may taper than what it is cut from, at least 1. A cut along a line of
    /// constant parameter does not change the taper; a slanting one shears the map from parameters
    /// to space, and cells would differ in size by this factor.
    double most_taper = 4;
    /// Most pieces of one quad.
    int most_pieces = 1024;
};

/// Quads of which some were cut.
struct CutAlongWalls {
    std::vector<SceneQuad> quads;
    int cut = 0;             ///< quads that were cut ...
    int pieces = 0;          ///< ... and the pieces they became
    Occurrences unfinished;  ///< lines of quads that would have become more than most_pieces
};

/// Cuts quads along the walls that stand on them or go through them, so that no cell of light lies
/// on both sides of a wall: a floor that is one quad below sixty rooms would carry light from each
/// to the next.
///
/// A quad is cut as a kd-tree cuts space: along the one straight line that the largest share of is
/// covered by walls, and then its pieces. A cut runs from one side to the opposite side, so that
/// pieces are convex quads again. A piece has the material, the polygon and the orientation of its
/// quad, and comes in its place; where pieces of a quad have a corner in one place, it is the same
/// to the last bit. Walls without thickness and thick ones, of which the piece below then sees
/// nothing, both count.
/// Lengths below a millionth of the scene's diagonal are taken as nothing, as in WeldedQuads.
CutAlongWalls cut_along_walls(const std::vector<SceneQuad>& quads, const WallCutRule& rule = {});

}  // namespace lightwell
