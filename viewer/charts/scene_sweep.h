#pragma once

#include <string>
#include <vector>

#include "radiance4d/progress.h"
#include "radiance4d/scene/scene.h"
#include "viewer/charts/measured_setting.h"
#include "viewer/charts/truncation_study.h"

namespace lightwell {

/// How much is measured.
struct SweepOptions {
    bool quick = false;   ///< fewer and larger errors, fewer lamps: a minute or two a scene
    std::string scratch;  ///< a file to be written and removed again, to know sizes
};

/// Accuracy against cost in one scene.
struct SceneSweep {
    std::vector<MeasuredSetting> settings;
    TruncationStudy truncation;
    std::vector<std::string> remarks;  ///< what was left out, and why; how errors were judged
};

/// Measures the default, the default with one setting changed by hand, the paper's oracle,
/// computing everything at the finest level and compressing then, and path tracing in every frame.
/// @throws as precompute, JudgedScene and write_operator_file
SceneSweep swept(const Scene& scene, const SweepOptions& options, const Progress& progress);

}  // namespace lightwell
