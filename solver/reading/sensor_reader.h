#pragma once

#include <string>
#include <vector>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// A point that measures illuminance, and where it looks.
struct Sensor {
    Vec3 position = Vec3::Zero();  ///< [m]
    Vec3 normal = Vec3::UnitZ();   ///< unit length
};

/// Reads a file of sensors: rows `x,y,z,nx,ny,nz` in metres, as many as wanted. The first row may
/// be exactly those names instead. Empty lines and lines that start with # are passed over; normals
/// may have any length.
/// @throws InputError with line and column for malformed or missing numbers, a normal without
/// length, and a file without sensors
std::vector<Sensor> read_sensors_csv(const std::string& path);

/// A point from which radiance is seen, and the direction that one looks along.
struct LookingPoint {
    Vec3 position = Vec3::Zero();    ///< [m]
    Vec3 direction = Vec3::UnitX();  ///< unit length
};

/// Reads a file of radiance probes, as read_sensors_csv does: rows `x,y,z,dx,dy,dz`.
std::vector<LookingPoint> read_probes_csv(const std::string& path);

}  // namespace lightwell
