#pragma once

#include <vector>

#include "radiance4d/basis/radiance_space.h"
#include "radiance4d/scene/visibility.h"
#include "solver/transport/oracle.h"

namespace lightwell {

/// What one side of a quad sees, from a few hundred rays.
struct SideSurvey {
    double escaped =
        0;  ///< share of the cosine-weighted hemisphere, averaged over the side, that meets nothing
    double backs = 0;     ///< share that meets the back of a quad
    double distance = 0;  ///< median distance of what is met [m], 0 if nothing is
};

/// Ray k of a survey: the first n of them are spread over the side and, by the cosine, over
/// directions.
struct SurveyRay {
    SurveyRay(const Element& element, int k);
    /// From one place of a side.
    SurveyRay(const Vec3& place, const Quad& side, int k);

    Vec3 origin;
    Vec3 direction;
};

/// Shoots `rays` cosine-distributed rays from points spread over each side. Deterministic,
/// parallel.
std::vector<SideSurvey> survey_sides(const std::vector<Element>& elements,
                                     const Visibility& visibility, int rays, OracleCost& cost);

}  // namespace lightwell
