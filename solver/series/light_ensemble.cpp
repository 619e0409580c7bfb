#include "solver/series/light_ensemble.h"

#include <cmath>

#include "radiance4d/operator/light_projection.h"

namespace lightwell {

namespace {

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
    if (counted == 0) return {Eigen::ArrayXd::Ones(n), Eigen::ArrayXd::Ones(n)};
    ensemble.direct = (ensemble.direct / counted).sqrt();
    ensemble.total = (ensemble.total / counted).sqrt();
    return ensemble;
}

}  // namespace lightwell
