#pragma once

#include <string>

#include "solver/reading/bare_geometry.h"

namespace lightwell {

/// What `lightwell info` was asked for.
struct InfoRequest {
    std::string subject;  ///< a .gto file, or a scene as for precompute
    BareGeometry bare;    ///< what a geometry file is taken for
    bool json = false;
};

/// Says what a .gto file holds and how it came to be, or what is in a scene and what is wrong with
/// it, on standard output.
/// @throws as inspect_operator_file and read_scene
void run_info(const InfoRequest& request);

}  // namespace lightwell
