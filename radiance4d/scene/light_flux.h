#pragma once

#include <vector>

#include "radiance4d/scene/convex_polygon.h"
#include "radiance4d/scene/light.h"

namespace lightwell {

/// Luminous flux of a light through a convex polygon [lm]: the integral of the intensity over the
/// polygon's solid angle, nothing between. Either side of the polygon counts; a light in the
/// polygon's plane sends nothing through it.
///
/// Exact to rounding for both kinds of light: no flux is lost or made where a cell is divided.
Rgb flux(const Light& light, const ConvexPolygon& polygon);

/// The sum over the visible pieces of a cell (see visible_part): the flux that the cell receives.
Rgb flux(const Light& light, const std::vector<ConvexPolygon>& pieces);

}  // namespace lightwell
