#pragma once

#include <cstddef>
#include <vector>

namespace lightwell {

/// What is measured for a scene, by how large it is and how much time there is.
struct SweepPlan {
    std::vector<double> errors;         ///< the default and the paper's oracle are asked for
    std::vector<double> judged_errors;  ///< the whole command, with its judge, is asked for
    std::vector<double> compressions;   ///< truncation after everything was computed
    std::vector<double> thresholds;     ///< of the truncation study
    double varied_error = 0.05;         ///< whose settings are varied by hand; one of `errors`
    double most_dense_cells = 5000;     ///< that everything is computed for
    double most_whole_cells = 5000;     ///< whose operator is studied whole
    int lamps = 40, points = 100;       ///< that judge
};

SweepPlan sweep_plan(std::size_t quads, bool is_glossy, bool quick);

}  // namespace lightwell
