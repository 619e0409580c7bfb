#pragma once

#include <optional>
#include <string>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// What a scene file says of its geometry, where there is only the geometry.
struct BareGeometry {
    std::optional<double> metres_per_unit;  ///< in [1e-9, 1e9]; 1 if not given
    std::optional<Vec3> up;                 ///< unit length; z if not given

    bool says_anything() const { return metres_per_unit || up; }
};

/// What is assumed of a file that holds geometry alone, for people: "lengths are in metres and z
/// points up"; empty for other files, and where all is said.
std::string assumed_of(const std::string& path, const BareGeometry& bare);

/// Metres in "m", "cm", "mm", "in" or "ft"; none for any other word.
std::optional<double> metres_in(const std::string& unit);
/// Whether a unit of so many metres is taken.
bool is_unit(double metres);
/// The axis "x", "y" or "z"; none for any other word.
std::optional<Vec3> axis_called(const std::string& name);

}  // namespace lightwell
