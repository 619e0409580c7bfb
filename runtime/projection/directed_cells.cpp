#include "runtime/projection/directed_cells.h"

#include <algorithm>
#include <cmath>

#include "radiance4d/basis/angular_reflection.h"
#include "radiance4d/basis/angular_shares.h"
#include "radiance4d/basis/direction_map.h"

namespace lightwell {

DirectedCells::DirectedCells(const Element& element)
    : haar_(element.space),
      angle_(element.angle),
      first_(element.first),
      centre_(element.geometry.centre()),
      frame_(local_frame(element.geometry)) {
    const CellTree& tree = haar_.tree();
    for (std::uint32_t m = 0; m < tree.functions(); ++m) {
        const Cell cell{tree.levels(), m};
        const ParameterRect r = tree.rect(cell);
        Points at;
        for (std::size_t k = 0; k < at.size(); ++k) {
            const double s = (static_cast<double>(k % points) + 0.5) / points;
            const double t = (static_cast<double>(k / points) + 0.5) / points;
            const Vec3 point =
                element.geometry.point(r.u0 + s * (r.u1 - r.u0), r.v0 + t * (r.v1 - r.v0));
            at[k] = (frame_.transpose() * (point - centre_)).cast<float>();
        }
        points_.push_back(at);
        per_flux_.push_back(static_cast<float>(1 / (M_PI * std::sqrt(element.space.area(cell)))));
    }
    const auto angles = static_cast<Eigen::Index>(angle_.functions());
    RowMatrix functions = RowMatrix::Identity(angles, angles) * std::sqrt(1.0 * angle_.functions());
    angular_basis(angle_.levels()).analyse(functions, angle_.levels());
    parts_.resize(angle_.functions());
    for (Eigen::Index a = 0; a < angles; ++a)
        for (Eigen::Index f = 0; f < angles; ++f)
            if (functions(f, a) != 0)
                parts_[static_cast<std::size_t>(a)].emplace_back(
                    static_cast<std::uint32_t>(f), static_cast<float>(functions(f, a)));
    seen_.resize(angle_.functions());
    light_ = PackedField::Zero(4, angles * tree.functions());
    cells_ = PackedField::Zero(4, tree.functions());
}

void DirectedCells::add(const Vec3& from, const PackedField& flux) {
    const Eigen::Vector3f source = (frame_.transpose() * (from - centre_)).cast<float>();
    const std::uint32_t cells = haar_.tree().functions();
    for (std::uint32_t m = 0; m < cells; ++m) {
        if (!(flux.col(m) > 0).any()) continue;
        float sum = 0;
        std::fill(seen_.begin(), seen_.end(), 0.0F);
        for (const Eigen::Vector3f& point : points_[m]) {
            const Eigen::Vector3f way = source - point;
            if (!(way[2] > 0)) continue;
            const float square = way.squaredNorm(), share = way[2] / (square * std::sqrt(square));
            for (const AngularShare& one :
                 angular_shares(angle_, angle_.levels(), way.cast<double>()))
                seen_[one.cell] += share * static_cast<float>(one.share);
            sum += share;
        }
        if (!(sum > 0)) continue;
        is_dark_ = false;
        const Packed mean = per_flux_[m] / sum * flux.col(m);
        for (std::size_t a = 0; a < seen_.size(); ++a) {
            if (!(seen_[a] > 0)) continue;
            for (const auto& [function, part] : parts_[a])
                light_.col(Eigen::Index{function} * cells + m) += seen_[a] * part * mean;
        }
    }
}

void DirectedCells::analyse(PackedField& field) {
    const std::uint32_t cells = haar_.tree().functions(), angles = angle_.functions();
    if (is_dark_) {
        field.middleCols(first_, Eigen::Index{cells} * angles).setZero();
        return;
    }
    for (std::uint32_t a = 0; a < angles; ++a) {
        cells_ = light_.middleCols(Eigen::Index{a} * cells, cells);
        haar_.analyse(cells_, field, first_ + a, angles);
    }
    light_.setZero();
    is_dark_ = true;
}

}  // namespace lightwell
