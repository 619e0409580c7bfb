#include "solver/series/light_ensemble.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "radiance4d/basis/direction_map.h"
#include "radiance4d/operator/light_projection.h"

namespace lightwell {

namespace {

/// Uniform in [0,1), the same on every platform.
double uniform(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Indirect light X - E on whole elements, by iteration.
Eigen::ArrayXd mean_indirect(const SymmetricOperator& mean_bounce,
                             const Eigen::ArrayXd& reflectance, const Eigen::ArrayXd& direct) {
    Eigen::ArrayXd indirect = Eigen::ArrayXd::Zero(direct.size());
    constexpr int steps = 30;
    for (int step = 0; step < steps; ++step) {
        Eigen::ArrayXd next = Eigen::ArrayXd::Zero(direct.size());
        mean_bounce.apply(reflectance * (direct + indirect), next);
        indirect = next;
    }
    return indirect;
}

}  // namespace

std::vector<Vec3> positions_in_the_open(const RadianceSpace& space, const Visibility& visibility,
                                        int count, unsigned seed) {
    std::mt19937_64 random(seed);
    std::vector<double> area_up_to;
    double area = 0;
    for (const Element& element : space.elements())
        area_up_to.push_back(area += element.area());
    std::vector<Vec3> positions;
    if (space.elements().empty()) return positions;
    const int most_tries = 100 * count;
    for (int k = 0; k < most_tries && static_cast<int>(positions.size()) < count; ++k) {
        const auto chosen =
            std::upper_bound(area_up_to.begin(), area_up_to.end() - 1, uniform(random) * area) -
            area_up_to.begin();
        const Element& element = space.element(static_cast<std::size_t>(chosen));
        const double u = uniform(random), v = uniform(random);
        const double s = uniform(random), t = uniform(random), along = uniform(random);
        const Vec3 start = element.geometry.point(u, v);
        const Vec3 direction = local_frame(element.geometry) * direction_from_square({s, t});
        const Hit hit = visibility.nearest(start, element.quad, direction);
        if (hit) positions.push_back(start + (0.1 + 0.8 * along) * hit.distance * direction);
    }
    return positions;
}

LightEnsemble light_ensemble(const RadianceSpace& space, const std::vector<Quad>& quads,
                             const OccluderTree& occluders, const std::vector<Vec3>& positions,
                             const SymmetricOperator& mean_bounce,
                             const Eigen::ArrayXd& reflectance) {
    const auto n = static_cast<Eigen::Index>(space.functions());
    LightEnsemble ensemble{Eigen::ArrayXd::Zero(n), Eigen::ArrayXd::Zero(n)};
    int counted = 0;
    for (const Vec3& position : positions) {
        PointLight light;
        light.position = position;
        light.intensity = Rgb::Ones();
        const Eigen::ArrayXd direct = projected_lights(space, {light}, quads, occluders).col(0);
        Eigen::ArrayXd means(static_cast<Eigen::Index>(space.elements().size()));
        for (std::size_t e = 0; e < space.elements().size(); ++e)
            means[static_cast<Eigen::Index>(e)] = direct[space.element(e).first];
        const Eigen::ArrayXd indirect = mean_indirect(mean_bounce, reflectance, means);
        const double norm = indirect.matrix().norm();
        if (!(norm > 0)) continue;
        Eigen::ArrayXd total = direct;
        for (std::size_t e = 0; e < space.elements().size(); ++e)
            total[space.element(e).first] += indirect[static_cast<Eigen::Index>(e)];
        ensemble.direct += (direct / norm).square();
        ensemble.total += (total / norm).square();
        ++counted;
    }
    if (counted > 0) {
        ensemble.direct = (ensemble.direct / counted).sqrt();
        ensemble.total = (ensemble.total / counted).sqrt();
    }
    return ensemble;
}

}  // namespace lightwell
