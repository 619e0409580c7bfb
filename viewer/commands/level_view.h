#pragma once

#include "radiance4d/basis/radiance_space.h"
#include "runtime/drawing/camera_rays.h"
#include "viewer/offscreen/render.h"

namespace lightwell {

/// Shows the wavelet mesh: finest cells with dark borders about a pixel wide, coloured by their
/// level along the ramp (see ramp_colour), a little darker where the surface turns away. Sides that
/// take no part are dark grey. Keeps references to both, and gives the light of a display in [0,1].
Shade level_shade(const RadianceSpace& space, const CameraRays& camera);

}  // namespace lightwell
