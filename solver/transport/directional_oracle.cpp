#include "solver/transport/directional_oracle.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

namespace {

/// Supports whose sizes are within this factor are refined together.
constexpr double similar_size = 1.6;

/// Width of an angular cell, as a length on the unit disk that directions are projected to.
double width_at(int level) {
    return std::sqrt(M_PI) / (1 << level);
}

}  // namespace

AngularDetail angular_detail(const AngularReflection& lobe, double diffuse, double specular) {
    const CellTree tree = angular_basis(lobe.level()).tree();
    RowMatrix reflection = specular * lobe.matrix();
    reflection(0, 0) += diffuse;
    const Eigen::ArrayXd norm = reflection.colwise().norm().transpose().array();
    AngularDetail detail(static_cast<std::size_t>(lobe.level()) + 1, 0);
    if (!(norm[0] > 0)) return detail;
    for (std::uint32_t a = 1; a < tree.functions(); ++a)
        for (int level = 0; level <= tree.level_of_function(a); ++level) {
            double& most = detail[static_cast<std::size_t>(level)];
            most = std::max(most, std::min(1.0, norm[a] / norm[0]));
        }
    return detail;
}

int DirectionalOracle::angular_level(const DirectedEnd& end, double spread,
                                     double importance) const {
    const int finest = end.element->angle.levels();
    int level = 0;
    while (level < finest &&
           (width_at(level) > 0.5 * spread ||
            !(importance * (*end.detail)[static_cast<std::size_t>(level)] < options_.tolerance)))
        ++level;
    return level;
}

bool DirectionalOracle::matters(const DirectedEnd& end, double spread, double importance) const {
    for (int level = 0; level <= end.element->angle.levels(); ++level) {
        if (width_at(level) > spread) continue;
        // Cells of this level and finer ones are narrower than the link.
        const int lost = std::max(0, level - 1);
        return !(importance * (*end.detail)[static_cast<std::size_t>(lost)] < options_.tolerance);
    }
    return false;
}

DirectedVerdict DirectionalOracle::judge(const DirectedCandidate& link) const {
    const DirectedEnd &x = link.receiver, &y = link.sender;
    const double area_x = x.element->space.area(x.space), area_y = y.element->space.area(y.space);
    const double importance = link.exchange / std::sqrt(area_x * area_y) *
                              std::sqrt(std::max(area_x, area_y) / scene_area_);
    const double spread =
        2 * (x.reach + y.reach) / std::max(link.distance, 0.5 * (x.reach + y.reach));

    DirectedVerdict verdict;
    verdict.receiver_angle = angular_level(x, spread, importance);
    verdict.sender_angle = angular_level(y, spread, importance);
    if (verdict.receiver_angle > 0) verdict.sub_domains |= receiver_angle;
    if (verdict.sender_angle > 0) verdict.sub_domains |= sender_angle;
    if (!matters(x, spread, importance) && !matters(y, spread, importance)) return verdict;
    const bool x_finest = x.element->space.tree().is_finest(x.space);
    const bool y_finest = y.element->space.tree().is_finest(y.space);
    if (!x_finest && (y_finest || similar_size * x.reach >= y.reach))
        verdict.sub_domains |= receiver_space;
    if (!y_finest && (x_finest || similar_size * y.reach >= x.reach))
        verdict.sub_domains |= sender_space;
    return verdict;
}

}  // namespace lightwell
