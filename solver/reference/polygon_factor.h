#pragma once

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// Share of the cosine-weighted hemisphere at `point` (unit `normal`) that an unshadowed quad
/// covers, in [0,1]: Lambert's formula on the part above the horizon. The quad counts from either
/// side.
double point_to_quad_factor(const Vec3& point, const Vec3& normal, const Quad& quad);

}  // namespace lightwell
