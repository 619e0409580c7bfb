#pragma once

#include <string>

#include "solver/reading/polygon_soup.h"

namespace lightwell {

/// Whether a path ends like a geometry file that read_mesh takes (.obj, .ply in any case).
bool is_mesh_file(const std::string& path);

/// Reads a geometry file by its extension: Wavefront OBJ or PLY.
/// @throws InputError for damaged files and for other formats, naming those that are read
PolygonSoup read_mesh(const std::string& path);

}  // namespace lightwell
