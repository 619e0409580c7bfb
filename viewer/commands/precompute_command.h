#pragma once

#include <string>

#include "solver/precompute.h"
#include "solver/reading/bare_geometry.h"
#include "solver/reading/material_choice.h"

namespace lightwell {

/// What `lightwell precompute` was asked for.
struct PrecomputeRequest {
    std::string scene;    ///< a scene file, a geometry file, or a folder with a scene.toml
    BareGeometry bare;    ///< what a geometry file is taken for
    std::string resumed;  ///< a .gto file to go on from, instead of a scene
    std::string output;   ///< the .gto file to write; by default the one to go on from
    PrecomputeOptions options;
    bool is_error_given = false;  ///< or the resumed file's is meant
    AlbedoAboveOne above_one = AlbedoAboveOne::refuse;
    bool json = false;     ///< the report as JSON
    bool quiet = false;    ///< no report for people, no warnings, no progress
    bool progress = true;  ///< a progress line, where standard error is a terminal
};

/// Reads a scene, computes its transport and writes it; the report goes to standard output,
/// warnings and progress to standard error. Where it is interrupted and has an operator already,
/// that one is written, unless the output's name is taken, or what it went on from is no worse.
/// @throws as read_scene, precompute and write_operator_file; else nothing changes under the
/// output's name then
void run_precompute(PrecomputeRequest request);

}  // namespace lightwell
