#pragma once

#include "solver/reading/scene_reader.h"
#include "viewer/commands/precompute_command.h"

namespace lightwell {

/// Completes a request that goes on from a file: what it does not say itself, the file says
/// (output, error, what was set by hand), and what the file reached is remembered.
///
/// @return the file's scene, and its lights
/// @throws as inspect_operator_file
ReadScene take_up(PrecomputeRequest& request);

/// What the computation was asked for, as the file keeps it; read by take_up.
std::string options_json(const PrecomputeOptions& options);

}  // namespace lightwell
