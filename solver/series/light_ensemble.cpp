#include "solver/series/light_ensemble.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/SparseCore>

#include "radiance4d/operator/light_projection.h"

namespace lightwell {

Eigen::ArrayXd white_light(const RadianceSpace& space, const Vec3& position,
                           const std::vector<Quad>& quads, const OccluderTree& occluders) {
    PointLight light;
    light.position = position;
    light.intensity = Rgb::Ones();
    return projected_lights(space, {light}, quads, occluders).col(0);
}

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

/// The nearest power of two of a share of the scene: neither the scale of a scene nor the rounding
/// of areas that are such powers decides.
int size_class_of(double share) {
    return static_cast<int>(std::lround(std::log2(share)));
}

/// No function is expected to stay dark: a light may come to stand where none of the ensemble did.
/// Raises every weight to a share of the root mean square over the functions of like support.
void raise_to_floor(const RadianceSpace& space, Eigen::ArrayXd& weight) {
    constexpr double share = 0.1;
    std::vector<int> size_class(static_cast<std::size_t>(weight.size()));
    std::map<int, std::pair<double, double>> squares_and_count;
    for (const Element& element : space.elements()) {
        const CellTree& tree = element.space.tree();
        for (std::uint32_t f = 0; f < tree.functions(); ++f) {
            const auto j = element.first + f;
            size_class[j] = size_class_of(element.space.area(tree.support(f)) / space.area());
            auto& [squares, count] = squares_and_count[size_class[j]];
            squares += weight[j] * weight[j];
            count += 1;
        }
    }
    for (Eigen::Index j = 0; j < weight.size(); ++j) {
        const auto& [squares, count] = squares_and_count[size_class[static_cast<std::size_t>(j)]];
        weight[j] = std::max(weight[j], share * std::sqrt(squares / count));
    }
}

}  // namespace

LightEnsemble light_ensemble(const RadianceSpace& space, const std::vector<Quad>& quads,
                             const OccluderTree& occluders, const std::vector<Vec3>& positions,
                             const SymmetricOperator& mean_bounce,
                             const Eigen::ArrayXd& reflectance, const Progress& progress) {
    const auto n = static_cast<Eigen::Index>(space.functions());
    LightEnsemble ensemble{Eigen::ArrayXd::Zero(n), Eigen::ArrayXd::Zero(n)};
    std::vector<Eigen::SparseVector<double>> direct;  // a light reaches a part of a large scene
    std::vector<Eigen::ArrayXd> indirect;             // by element
    double squares = 0;
    for (const Vec3& position : positions) {
        progress.check();
        const Eigen::ArrayXd field = white_light(space, position, quads, occluders);
        Eigen::ArrayXd means(static_cast<Eigen::Index>(space.elements().size()));
        for (std::size_t e = 0; e < space.elements().size(); ++e)
            means[static_cast<Eigen::Index>(e)] = field[space.element(e).first];
        indirect.push_back(mean_indirect(mean_bounce, reflectance, means));
        squares += indirect.back().square().sum();
        direct.emplace_back(field.matrix().sparseView());
        progress.say("ensemble",
                     static_cast<double>(direct.size()) / static_cast<double>(positions.size()));
    }
    if (!(squares > 0)) return {Eigen::ArrayXd::Ones(n), Eigen::ArrayXd::Ones(n)};
    // A light that almost nothing reflects must not count for more than the others.
    const auto count = static_cast<double>(direct.size());
    const double least = 0.5 * std::sqrt(squares / count);
    for (std::size_t k = 0; k < direct.size(); ++k) {
        const double norm = std::max(indirect[k].matrix().norm(), least);
        const double scale = 1 / (norm * norm * count);
        for (Eigen::SparseVector<double>::InnerIterator it(direct[k]); it; ++it) {
            ensemble.direct[it.index()] += scale * it.value() * it.value();
            ensemble.total[it.index()] += scale * it.value() * it.value();
        }
        for (std::size_t e = 0; e < space.elements().size(); ++e) {
            const std::uint32_t mean = space.element(e).first;
            const double through = direct[k].coeff(mean);
            const double all = through + indirect[k][static_cast<Eigen::Index>(e)];
            ensemble.total[mean] += scale * (all * all - through * through);
        }
    }
    ensemble.direct = ensemble.direct.sqrt();
    ensemble.total = ensemble.total.sqrt();
    raise_to_floor(space, ensemble.direct);
    raise_to_floor(space, ensemble.total);
    return ensemble;
}

}  // namespace lightwell
