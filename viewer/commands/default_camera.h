#pragma once

#include <vector>

#include "radiance4d/basis/radiance_space.h"
#include "radiance4d/scene/scene.h"
#include "radiance4d/scene/visibility.h"

namespace lightwell {

/// A camera for a scene that has none: at eye level above a floor with a ceiling (or above the
/// lowest point, where there is none), looking level across the scene from where it sees most. Of a
/// grid of places on all floors it is the one whose picture has the greatest mean distance,
/// counting only surfaces that take part in transport, so that it stands neither in a block nor
/// behind a wall.
Camera default_camera(const Scene& scene, const RadianceSpace& space, const Visibility& visibility);

}  // namespace lightwell
