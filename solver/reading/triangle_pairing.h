#pragma once

#include <array>
#include <vector>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// A triangle between vertices, counter-clockwise seen from the front. Vertices in the same place
/// have the same index.
struct Triangle {
    std::array<int, 3> vertex;
    int material = -1;
    int face = 0;  ///< polygon it came from
};

/// Two triangles that make one quad.
struct TrianglePair {
    int first = 0, second = 0;  ///< indices of the triangles, first < second
    std::array<int, 4> vertex;  ///< the quad's corners, counter-clockwise
};

/// Which triangles become one quad.
struct PairingRule {
    /// How far the quad's corners may lie from their mean plane, relative to its diameter: what six
    /// decimal digits in a file leave of an exact plane.
    double planarity = 1e-5;
    /// Least height of a corner over the line between its neighbours, relative to the diameter: the
    /// quad must be strictly convex.
    double convexity = 1e-3;
};

/// Pairs triangles that share a side, have the same material, face the same way and lie in one
/// plane, so that both together are a strictly convex quad. Each triangle is used at most once.
///
/// All candidates are taken in the order of their worst corner (largest sine first, in steps of
/// 1e-6, so that rounding does not decide), then of the lower triangle, then of the higher one;
/// each is accepted if both of its triangles are still free. Rectangles that were cut along a
/// diagonal come together again first, because their sine is 1.
std::vector<TrianglePair> pair_triangles(const std::vector<Vec3>& vertices,
                                         const std::vector<Triangle>& triangles,
                                         const PairingRule& rule = {});

}  // namespace lightwell
