#pragma once

#include <string>
#include <vector>

#include "radiance4d/scene/scene.h"
#include "solver/reading/reading_report.h"

namespace lightwell {

/// Leaves out quads that lie where an earlier one does, with its corners: two surfaces in one place
/// would hide each other, and rays could not tell them apart. What is modelled double-sided, as a
/// quad and its copy the other way round, becomes one quad whose both sides reflect, and emit if
/// both did, by the first one's material, for which a twin is added where that had a black back.
///
/// @param file  for warnings: one for copies, one for those whose material differed
/// @return how many were left out
int leave_out_copies(std::vector<SceneQuad>& quads, std::vector<Material>& materials,
                     const std::string& file, std::vector<Warning>& warnings);

}  // namespace lightwell
