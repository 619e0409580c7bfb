#include "solver/series/light_ensemble.h"

#include <algorithm>
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
                             const Eigen::ArrayXd& reflectance, const Progress& progress) {
    const auto n = static_cast<Eigen::Index>(space.functions());
    LightEnsemble ensemble{Eigen::ArrayXd::Zero(n), Eigen::ArrayXd::Zero(n)};
    std::vector<Eigen::ArrayXd> direct, total;
    std::vector<double> norm;
    double squares = 0;
    for (const Vec3& position : positions) {
        progress.check();
        PointLight light;
        light.position = position;
        light.intensity = Rgb::Ones();
        direct.push_back(projected_lights(space, {light}, quads, occluders).col(0));
        Eigen::ArrayXd means(static_cast<Eigen::Index>(space.elements().size()));
        for (std::size_t e = 0; e < space.elements().size(); ++e)
            means[static_cast<Eigen::Index>(e)] = direct.back()[space.element(e).first];
        const Eigen::ArrayXd indirect = mean_indirect(mean_bounce, reflectance, means);
        total.push_back(direct.back());
        for (std::size_t e = 0; e < space.elements().size(); ++e)
            total.back()[space.element(e).first] += indirect[static_cast<Eigen::Index>(e)];
        norm.push_back(indirect.matrix().norm());
        squares += norm.back() * norm.back();
    }
    // A light that almost nothing reflects must not count for more than the others.
    const double least =
        0.5 * std::sqrt(squares / static_cast<double>(std::max<std::size_t>(norm.size(), 1)));
    const auto counted = static_cast<double>(squares > 0 ? norm.size() : 0);
    for (std::size_t k = 0; k < norm.size() && squares > 0; ++k) {
        ensemble.direct += (direct[k] / std::max(norm[k], least)).square();
        ensemble.total += (total[k] / std::max(norm[k], least)).square();
    }
    if (counted == 0) return {Eigen::ArrayXd::Ones(n), Eigen::ArrayXd::Ones(n)};
    ensemble.direct = (ensemble.direct / counted).sqrt();
    ensemble.total = (ensemble.total / counted).sqrt();
    return ensemble;
}

}  // namespace lightwell
