#pragma once

#include <string>
#include <vector>

#include "radiance4d/scene/quad.h"
#include "solver/reading/reading_report.h"

namespace lightwell {

/// Largest coordinate a file may hold, in its own unit. Beyond it, areas and volumes would lose all
/// meaning in double precision long before they overflow.
constexpr double largest_coordinate = 1e12;

/// A polygon of a geometry file: `count` corners from PolygonSoup::corners[first] on,
/// counter-clockwise seen from the front.
struct Polygon {
    int first = 0;
    int count = 0;
    int material = -1;  ///< index into PolygonSoup::materials, -1: none is named
    int line = 0;       ///< line of the file, 0 if not known
};

/// A name as it stands in a file.
struct NamedPlace {
    std::string name;
    Place place;
};

/// A geometry file as it is: polygons of any size and shape, in the file's own unit.
struct PolygonSoup {
    std::string file;
    std::vector<Vec3> vertices;
    std::vector<int> corners;  ///< indices into vertices, checked
    std::vector<Polygon> polygons;
    std::vector<NamedPlace> materials;           ///< in order of their first use
    std::vector<NamedPlace> material_libraries;  ///< MTL files as named in the file
    std::vector<Warning> warnings;
};

}  // namespace lightwell
