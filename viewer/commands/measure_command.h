#pragma once

#include <optional>
#include <string>

namespace lightwell {

/// What `lightwell measure` was asked for.
struct MeasureRequest {
    std::string operator_file;           ///< .gto
    std::optional<std::string> sensors;  ///< a file of sensors ...
    std::optional<std::string> grid;     ///< ... or the name of a sensor grid of the scene
    std::optional<std::string> probes;   ///< ... or a file of radiance probes
    std::optional<std::string> lights;   ///< a file of lights; the scene's own if not given
    std::string output;                  ///< a CSV file; standard output if empty
    /// Probes without a gather: whether the light of lamps forgets its direction on glossy
    /// surfaces.
    bool spread_lamps = false;
    bool gather = true;  ///< a final gather at each sensor, or the smoothed basis as it is
};

/// Directions along either side of the hemisphere that a sensor gathers from. The gather's own
/// error must be small beside the operator's: 90 up to 1 %, 64 at 2 %, 32 from 8 % on.
/// @param error  relative, that the operator was computed for
int gather_strata(double error);

/// Prints the illuminance at each sensor as CSV with the header
///     x,y,z,nx,ny,nz,direct_r,direct_g,direct_b,indirect_r,indirect_g,indirect_b,lux
/// in the order of the sensors; normals are of unit length, light in lx.
/// For probes it prints the radiance that is seen, in cd/m2, with the header
///     x,y,z,dx,dy,dz,direct_r,direct_g,direct_b,indirect_r,indirect_g,indirect_b,cd_m2
/// The direct part is what the surface that is seen emits and makes of the light of lamps and
/// emitting quads, the indirect one what it makes of light that was reflected before.
/// @throws InputError for files and names that cannot be used, and, without the gather, for a
/// sensor that lies on no surface
void run_measure(const MeasureRequest& request);

}  // namespace lightwell
