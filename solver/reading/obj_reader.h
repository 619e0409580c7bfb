#pragma once

#include <string>

#include "solver/reading/polygon_soup.h"

namespace lightwell {

/// Reads a Wavefront OBJ file: v, f, usemtl and mtllib. Groups, objects, smoothing, texture
/// coordinates, normals, vertex colours, lines and points do not matter for light and are passed
/// over; anything else is passed over with a warning. Indices may be negative (relative) and may
/// name vertices that follow later. Material libraries are named in the result, not read.
/// @throws InputError with file, line and column for malformed, infinite or missing numbers, for
/// indices that name no vertex, and for a file without polygons.
PolygonSoup read_obj(const std::string& path);

}  // namespace lightwell
