#include "runtime/outgoing/lobe_table.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "radiance4d/basis/angular_reflection.h"
#include "radiance4d/basis/direction_map.h"
#include "radiance4d/scene/brdf.h"

namespace lightwell {

namespace {

/// Cells of the grid along either side, for each cell of the incident light.
constexpr int finer = 8;
constexpr int fewest_cells = 32, most_cells = 64;
/// Points along either side of the square at which the lobe is looked at.
constexpr int quadrature = 64;
/// Coefficients below this share of the lobe's norm are left out.
constexpr float negligible = 1e-3F;
/// Cosine of the most grazing direction that is tabulated.
constexpr double least_cosine = 0.02;

/// Means over all angular cells of pi times the lobe towards a direction, as half-densities.
Eigen::MatrixXd over_cells(const Lobe& lobe, const CellTree& angle, const Vec3& towards) {
    const int points = std::max(2, quadrature >> angle.levels());
    RowMatrix result(angle.functions(), 1);
    for (std::uint32_t m = 0; m < angle.functions(); ++m) {
        const ParameterRect r = angle.rect({angle.levels(), m});
        double sum = 0;
        for (int i = 0; i < points; ++i)
            for (int j = 0; j < points; ++j)
                sum +=
                    lobe_value(lobe,
                               direction_from_square({r.u0 + (i + 0.5) / points * (r.u1 - r.u0),
                                                      r.v0 + (j + 0.5) / points * (r.v1 - r.v0)}),
                               towards);
        result(m, 0) = M_PI * sum / (points * points) / std::sqrt(angle.functions());
    }
    return result;
}

Vec3 kept_off_the_horizon(Vec3 direction) {
    direction[2] = std::max(direction[2], least_cosine);
    return direction.normalized();
}

}  // namespace

LobeTable::LobeTable(const Lobe& lobe, int level)
    : cells_(std::clamp(finer << level, fewest_cells, most_cells)),
      nodes_(static_cast<std::size_t>((cells_ + 1) * (cells_ + 1))) {
    constexpr int albedos = 96;  // dense at grazing angles, where it may be steep
    for (int k = 0; k <= albedos; ++k)
        albedo_.push_back(lobe_albedo(lobe, std::pow(k / double{albedos}, 2)));
    const HaarBasis angular = angular_basis(level);
    tbb::parallel_for(std::size_t{0}, nodes_.size(), [&](std::size_t n) {
        const auto side = static_cast<std::size_t>(cells_) + 1;
        const Vec3 towards = kept_off_the_horizon(direction_from_square(
            {static_cast<double>(n % side) / cells_, static_cast<double>(n / side) / cells_}));
        RowMatrix coefficient = over_cells(lobe, angular.tree(), towards);
        angular.analyse(coefficient, level);
        if (coefficient(0, 0) > 0) coefficient /= coefficient(0, 0);
        const auto least = static_cast<double>(negligible) * coefficient.norm();
        for (Eigen::Index f = 0; f < coefficient.rows(); ++f)
            if (f == 0 || std::abs(coefficient(f, 0)) > least) {
                nodes_[n].function.push_back(static_cast<std::uint16_t>(f));
                nodes_[n].coefficient.push_back(static_cast<float>(coefficient(f, 0)));
            }
    });
}

Rgb LobeTable::reflected(const Vec3& towards, Eigen::Ref<const AngularLight> incident) const {
    const Vec2 at = square_from_direction(kept_off_the_horizon(towards)) * cells_;
    const auto i = static_cast<std::size_t>(std::clamp(static_cast<int>(at[0]), 0, cells_ - 1));
    const auto j = static_cast<std::size_t>(std::clamp(static_cast<int>(at[1]), 0, cells_ - 1));
    const double s = at[0] - static_cast<double>(i), t = at[1] - static_cast<double>(j);
    Eigen::Array3f sum = Eigen::Array3f::Zero();
    const auto add = [&](std::size_t column, std::size_t row, double share) {
        const Node& node = nodes_[row * (static_cast<std::size_t>(cells_) + 1) + column];
        Eigen::Array3f one = Eigen::Array3f::Zero();
        for (std::size_t k = 0; k < node.function.size(); ++k)
            one += node.coefficient[k] * incident.row(node.function[k]).transpose();
        sum += static_cast<float>(share) * one;
    };
    add(i, j, (1 - s) * (1 - t));
    add(i + 1, j, s * (1 - t));
    add(i, j + 1, (1 - s) * t);
    add(i + 1, j + 1, s * t);
    return albedo(towards[2]) * sum.cast<double>().max(0.0);
}

double LobeTable::albedo(double cosine) const {
    const auto entries = static_cast<double>(albedo_.size() - 1);
    const double place = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * entries;
    const auto below = std::min(static_cast<std::size_t>(place), albedo_.size() - 2);
    const double rest = place - static_cast<double>(below);
    return (1 - rest) * albedo_[below] + rest * albedo_[below + 1];
}

}  // namespace lightwell
