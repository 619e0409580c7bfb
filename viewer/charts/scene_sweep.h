#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "radiance4d/progress.h"
#include "radiance4d/scene/scene.h"
#include "viewer/charts/measured_setting.h"
#include "viewer/charts/truncation_study.h"

namespace lightwell {

/// Accuracy against cost in one scene. What cannot be had of a scene with gloss is empty.
struct SceneSweep {
    std::vector<MeasuredSetting> settings;
    /// The default as pictures gather it, and what became of it where one of its settings was
    /// changed by hand.
    MeasuredSetting unvaried;
    std::vector<MeasuredSetting> varied;
    TruncationStudy truncation;
    std::vector<std::string> remarks;  ///< what was left out, and why; how errors were judged
};

/// Measures the default, the default with one setting changed by hand, the paper's oracle,
/// computing everything at the finest level and compressing then, and path tracing in every frame.
/// Of scenes with gloss, the default and path tracing alone. Emitting quads are off.
/// @param quick  fewer and larger errors, fewer lamps: a minute or two a scene
/// @throws as precompute and JudgedScene
SceneSweep swept(const Scene& scene, bool quick, const Progress& progress);

}  // namespace lightwell
