#pragma once

#include <string>

#include "solver/reading/scene_reader.h"

namespace lightwell {

/// The scene that a user names: a scene file, a geometry file, or a folder with a scene.toml.
/// @param bare  must say nothing unless it is a geometry file
/// @throws as read_scene
ReadScene read_scene_argument(const std::string& path, AlbedoAboveOne above_one,
                              const BareGeometry& bare = {});

}  // namespace lightwell
