#pragma once

#include <string>

#include "solver/reading/bare_geometry.h"

namespace lightwell {

/// What `lightwell chart` was asked for.
struct ChartRequest {
    std::string scene;   ///< as for precompute
    BareGeometry bare;   ///< what a geometry file is taken for
    std::string output;  ///< a folder; made if it is not there
    bool quick = false;
    bool progress = true;  ///< a progress line, where standard error is a terminal
};

/// Measures accuracy against cost in a scene and writes measured.csv, one SVG and one CSV a chart,
/// and index.html, which holds all of them and needs no other file.
/// @throws as read_scene, swept and write_atomically
void run_chart(const ChartRequest& request);

}  // namespace lightwell
