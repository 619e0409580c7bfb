#pragma once

#include <cstddef>
#include <vector>

#include "radiance4d/scene/quad.h"
#include "solver/reference/random_stream.h"

namespace lightwell {

/// Fills `points` with its size of points in [0,1)^2, each uniform by itself, together evenly
/// spread, in random order: the first two Sobol' dimensions under a random digital shift. Best
/// spread when the size is a power of two.
void draw_even_points(std::vector<Vec2>& points, RandomStream& random);

/// Unit direction about the unit `normal` with density cos(theta)/pi per solid angle.
Vec3 cosine_direction(const Vec3& normal, const Vec2& square);

/// Unit direction uniform in the cone about the unit `axis` whose edge has the given cosine (-1:
/// the whole sphere); density 1/(2 pi (1 - edge_cosine)).
Vec3 cone_direction(const Vec3& axis, double edge_cosine, const Vec2& square);

/// Point uniform by area on a convex quad; neighbours in the square stay neighbours on each half of
/// the quad.
Vec3 uniform_point_on(const Quad& quad, const Vec2& square);

}  // namespace lightwell
