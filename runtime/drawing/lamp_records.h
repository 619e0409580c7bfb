#pragma once

#include <vector>

#include "radiance4d/scene/light.h"
#include "runtime/drawing/surface_records.h"

namespace lightwell {

/// Appends what shaders must know of a lamp, three records: its position (scaled), its intensity
/// over the square of the scene's extent, its axis; with the intensity and the axis the cosines
/// within and without which a spot has all or none of its intensity.
void append_records(const Light& light, const SceneScale& scale, std::vector<Record>& records);

}  // namespace lightwell
