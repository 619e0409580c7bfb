#pragma once

#include <vector>

#include "solver/reference/error_size.h"
#include "solver/reference/surface_points.h"

namespace lightwell {

/// Evenly spread points, what is shown there of one lamp's light, and, as weights, how well they
/// can be seen.
struct CandidatePoints {
    std::vector<SurfacePoint> points;
    ShownPoints shown;
    /// What is shown there in another way; empty where that is not known.
    std::vector<Rgb> otherwise;
};

/// By how much the two ways differ, relative to the light, squared.
double relative_difference(const CandidatePoints& candidates);

/// Some of them, for a judge.
struct ChosenPoints {
    std::vector<SurfacePoint> points;
    std::vector<double> visible;  ///< by point: how well it can be seen
    /// What is shown there; the weights make up for what was chosen oftener.
    ShownPoints shown;
};

/// Chooses `count` points, half of them by how well they can be seen and half by that times the
/// square of the light shown there, since a few bright places hold most of the error. Where another
/// way to show them is known, three tenths go by the square of the difference instead. Where next
/// to nothing is shown, up to eight times as many are chosen, unless most is dark.
///
/// Systematic sampling, so that what is spread evenly stays so; none if nothing can be seen.
/// @param offset  random, in [0,1)
ChosenPoints chosen_points(const CandidatePoints& candidates, int count, double offset);

}  // namespace lightwell
