#pragma once

#include <vector>

#include "radiance4d/operator/radiance_field.h"
#include "radiance4d/scene/light.h"
#include "radiance4d/scene/occluder_tree.h"

namespace lightwell {

/// E: the direct light of point and spot lights, projected on the basis (WRT section 5.1). The
/// coefficient of a finest cell is the flux on it, Int I dw over the solid angle through which the
/// light sees the cell, exact to rounding, with shadows cut out by geometry; wavelet coefficients
/// are its transform. Where the element has angular functions, the light keeps its direction (see
/// add_directed_light).
///
/// Cells that no quad can stand before cost a closed form; the rest are refined only as far as
/// shadows reach.
RadianceField projected_lights(const RadianceSpace& space, const std::vector<Light>& lights,
                               const std::vector<Quad>& quads, const OccluderTree& occluders);

}  // namespace lightwell
