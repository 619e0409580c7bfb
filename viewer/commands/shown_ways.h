#pragma once

#include "solver/reference/verification.h"
#include "viewer/commands/opened_operator.h"

namespace lightwell {

// The ways in which the program shows indirect light, for verification. Emitting quads must be off
// in the operator's scene (see without_emission); it must outlive what is returned.

/// "picture": the gathered operator, reconstructed smoothly from the basis. What `--error`
/// promises.
ShownLight picture_way(const OpenedOperator& opened);

/// "measure": solved, and gathered once more at every point, as `lightwell measure` does.
ShownLight measure_way(const OpenedOperator& opened);

/// "textures": the stored operator, from one texture per quad: what a moving lamp shows.
ShownLight textures_way(const OpenedOperator& opened);

}  // namespace lightwell
