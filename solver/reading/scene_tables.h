#pragma once

#include <string>
#include <vector>

#include "radiance4d/scene/dimmed_light.h"
#include "radiance4d/scene/scene.h"
#include "solver/reading/mtl_reader.h"
#include "solver/reading/toml_table.h"

namespace lightwell {

// The tables of a scene, lights or camera file; their keys are documented in scene_reader.h. All
// throw InputError with line and column for unknown keys, wrong types and values out of range.

/// The lights of every [[light]], in their order; those without a name are "light 1", ...
std::vector<DimmedLight> lights_from(const TomlTable& file);
/// The light of a [[light]] table, by that name.
DimmedLight light_from(const TomlTable& table, const std::string& name);
/// The camera of a [camera] table. @param up the direction that is up unless the table says
Camera camera_from(const TomlTable& table, const Vec3& up);
/// The grids of every [[sensors]], in their order; those without a name are "sensors 1", ...
std::vector<SensorGrid> sensor_grids_from(const TomlTable& file);
/// The materials of every [material.NAME], in alphabetical order.
std::vector<MaterialDescription> materials_from(const TomlTable& file);

}  // namespace lightwell
