#pragma once

#include <string>

#include "solver/precompute.h"
#include "solver/reading/material_choice.h"

namespace lightwell {

/// What `lightwell precompute` was asked for.
struct PrecomputeRequest {
    std::string scene;   ///< a scene file, a geometry file, or a folder with a scene.toml
    std::string output;  ///< the .gto file to write
    PrecomputeOptions options;
    AlbedoAboveOne above_one = AlbedoAboveOne::refuse;
    bool json = false;     ///< the report as JSON
    bool quiet = false;    ///< no report for people, no warnings, no progress
    bool progress = true;  ///< a progress line, where standard error is a terminal
};

/// Reads a scene, computes its transport and writes it; the report goes to standard output,
/// warnings and progress to standard error.
/// @throws as read_scene, precompute and write_operator_file; nothing is left under the output's
/// name then
void run_precompute(const PrecomputeRequest& request);

}  // namespace lightwell
