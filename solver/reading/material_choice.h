#pragma once

#include <string>
#include <vector>

#include "radiance4d/scene/material.h"
#include "solver/reading/mtl_reader.h"
#include "solver/reading/polygon_soup.h"

namespace lightwell {

/// The materials of a scene and which of them each name of the geometry file means.
struct MaterialChoice {
    std::vector<Material> materials;
    std::vector<int> of_soup;  ///< for every entry of PolygonSoup::materials
    int of_unnamed = -1;       ///< for polygons that name none; -1: there are no such polygons
    std::vector<std::string> files;  ///< MTL files that were read
};

/// What to do with a material that reflects more light than it receives, at any angle.
enum class AlbedoAboveOne {
    refuse,  ///< an InputError that names material, angle and value
    scale,   ///< scale it down to 1 and warn
};

/// Chooses materials by name. What the scene file says (`own`) goes before the MTL files the
/// geometry names (a scene's table may give only what it changes), and those before the defaults:
/// 0.5 grey, no emission, both sides. Polygons without a material, and those whose material nobody
/// describes, get `default_name` if it is not empty, else 0.5 grey; everything that had to be
/// assumed is said in a warning. A material with a specular reflectance has a GGX lobe if there is
/// a roughness, a Phong lobe if there is an exponent.
/// @throws InputError for a damaged MTL file (one that does not exist is a warning), and for a
/// material whose albedo exceeds 1 unless `above_one` says otherwise
MaterialChoice choose_materials(const PolygonSoup& soup,
                                const std::vector<MaterialDescription>& own,
                                const std::string& default_name, AlbedoAboveOne above_one,
                                std::vector<Warning>& warnings);

}  // namespace lightwell
