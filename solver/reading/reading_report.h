#pragma once

#include <string>
#include <utility>
#include <vector>

#include "radiance4d/failure.h"

namespace lightwell {

/// Something a reader had to assume or leave out, and where. The scene is usable all the same.
struct Warning {
    Place place;
    std::string message;

    /// "room.obj:57: message", or the message alone where no place is known.
    std::string to_string() const;
};

/// What became of the polygons of a geometry file. All counts are of polygons of the file unless
/// they say otherwise.
struct PolygonCounts {
    int faces = 0;       ///< polygons in the file
    int quads = 0;       ///< convex planar quads, kept as they are
    int triangles = 0;   ///< triangles
    int larger = 0;      ///< convex planar polygons of five and more corners, cut into quads
    int concave = 0;     ///< concave planar polygons, cut into triangles
    int bent = 0;        ///< polygons beyond the planarity tolerance, cut into triangles
    int flattened = 0;   ///< polygons a little off their mean plane, moved onto it
    int degenerate = 0;  ///< polygons without area, left out
    int crossing = 0;    ///< polygons whose outline crosses itself, left out
    int pairs = 0;       ///< quads made of two triangles, whether of the file or cut from a polygon
    int cut = 0;         ///< triangles cut into three quads each
    int copies = 0;      ///< quads where an earlier one lies, left out
    int along_walls = 0;  ///< quads, kept or made, cut along the walls that stand on them
    int pieces = 0;       ///< quads that those became
    int elements = 0;     ///< quads of the scene
};

/// One line for people: "2,575 faces: 2,528 quads, 47 triangles; 40 triangles paired into 20 quads,
/// 7 cut into 21 quads, 2 quads cut along walls into 143; 2,710 quads in all".
std::string to_string(const PolygonCounts& counts);

/// What reading a scene met with.
struct ReadingReport {
    PolygonCounts counts;
    std::vector<Warning> warnings;
    std::vector<std::string> files;  ///< that were read
};

/// Gathers places at which the same thing happened, so that a file with ten thousand odd faces
/// gives one warning.
class Occurrences {
  public:
    /// @param line 0 if not known
    void add(int line, int column = 0);
    int count() const { return count_; }
    /// Appends one warning at the first place; `message` may end in the other places: " (also at
    /// lines 7, 9 and 12 more)". Nothing is appended where nothing happened.
    void report(const std::string& file, const std::string& message,
                std::vector<Warning>& warnings) const;

  private:
    int count_ = 0;
    std::vector<std::pair<int, int>> first_;  ///< line and column of the first few
};

/// 12345 as "12,345", whatever the locale.
std::string with_separators(long long number);

}  // namespace lightwell
