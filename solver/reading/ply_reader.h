#pragma once

#include <string>

#include "solver/reading/polygon_soup.h"

namespace lightwell {

/// Reads a PLY file, version 1.0: ascii, binary_little_endian or binary_big_endian. Taken are x, y
/// and z of the element `vertex` and the list vertex_indices (or vertex_index) of the element
/// `face`; other elements and properties are passed over. A text must have one row a line.
/// @throws InputError with file, line and column (binary: byte and row) for anything damaged, for
/// numbers that are not finite, for indices that name no vertex, and for a file without polygons
PolygonSoup read_ply(const std::string& path);

}  // namespace lightwell
