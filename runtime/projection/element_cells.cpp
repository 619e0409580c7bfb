#include "runtime/projection/element_cells.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

namespace {

double longer_diagonal(const Quad& quad) {
    return std::max((quad.vertex[2] - quad.vertex[0]).norm(),
                    (quad.vertex[3] - quad.vertex[1]).norm());
}

ElementCells::Nodes nodes_of(const Quad& cell, const Vec3& origin) {
    const double low = 0.5 - 0.5 / std::sqrt(3.0), high = 1 - low;
    const Vec2 parameters[] = {{low, low}, {high, low}, {high, high}, {low, high}};
    ElementCells::Nodes nodes;
    Quad points;
    for (std::size_t k = 0; k < 4; ++k) {
        points.vertex[k] = cell.point(parameters[k][0], parameters[k][1]);
        nodes.area[static_cast<Eigen::Index>(k)] =
            static_cast<float>(0.25 * cell.jacobian(parameters[k][0], parameters[k][1]));
    }
    nodes.at = FourPoints(points, origin);
    const double size = longer_diagonal(cell);
    nodes.squared_size = static_cast<float>(size * size);
    return nodes;
}

}  // namespace

ElementCells::ElementCells(const Element& element)
    : haar_(element.space),
      first_(element.first),
      stride_(element.angle.functions()),
      centre_(element.geometry.centre()),
      normal_(element.geometry.normal()),
      extent_(longer_diagonal(element.geometry)) {
    for (std::uint32_t position = 0; position < tree().positions(); ++position) {
        const Cell cell = tree().at(position);
        const Quad quad = element.cell(cell);
        corners_.emplace_back(quad, centre_);
        if (!tree().is_finest(cell)) continue;
        cell_.push_back(quad);
        nodes_.push_back(nodes_of(quad, centre_));
        per_flux_.push_back(
            static_cast<float>(1 / (M_PI * std::sqrt(element.space.area_at(position)))));
    }
}

void ElementCells::analyse(PackedField& flux, PackedField& field) const {
    for (std::uint32_t m = 0; m < tree().functions(); ++m)
        flux.col(m) *= per_flux_[m];
    haar_.analyse(flux, field, first_, stride_);
}

}  // namespace lightwell
