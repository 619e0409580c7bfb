#include "solver/transport/survey.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "radiance4d/basis/direction_map.h"

namespace lightwell {

namespace {

/// Point k of n of a rank-1 lattice in four dimensions, on the generalised golden ratio (Roberts
/// 2018).
Eigen::Array4d lattice(int k) {
    const Eigen::Array4d step(0.85667488385450287, 0.73389185662718776, 0.62870672083239870,
                              0.53859725722360993);
    const Eigen::Array4d x = 0.5 + k * step;
    return x - x.floor();
}

}  // namespace

SurveyRay::SurveyRay(const Element& element, int k) {
    const Eigen::Array4d w = lattice(k);
    origin = element.geometry.point(w[0], w[1]);
    direction = local_frame(element.geometry) * direction_from_square({w[2], w[3]});
}

SurveyRay::SurveyRay(const Vec3& place, const Quad& side, int k) {
    const Eigen::Array4d w = lattice(k);
    origin = place;
    direction = local_frame(side) * direction_from_square({w[2], w[3]});
}

std::vector<SideSurvey> survey_sides(const std::vector<Element>& elements,
                                     const Visibility& visibility, int rays, OracleCost& cost) {
    std::vector<SideSurvey> result(elements.size());
    tbb::parallel_for(std::size_t{0}, elements.size(), [&](std::size_t e) {
        const Element& element = elements[e];
        std::vector<double> met;
        for (int k = 0; k < rays; ++k) {
            const SurveyRay ray(element, k);
            const Hit hit = visibility.nearest(ray.origin, element.quad, ray.direction);
            if (!hit) continue;
            met.push_back(hit.distance);
            if (!hit.front) result[e].backs += 1.0 / rays;
        }
        result[e].escaped = 1 - static_cast<double>(met.size()) / rays;
        if (met.empty()) return;
        const auto middle = met.begin() + static_cast<std::ptrdiff_t>(met.size() / 2);
        std::nth_element(met.begin(), middle, met.end());
        result[e].distance = *middle;
    });
    cost.rays += elements.size() * static_cast<std::size_t>(rays);
    return result;
}

}  // namespace lightwell
