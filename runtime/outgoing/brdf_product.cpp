#include "runtime/outgoing/brdf_product.h"

#include <algorithm>
#include <cmath>

#include "radiance4d/basis/angular_reflection.h"
#include "radiance4d/basis/direction_map.h"
#include "radiance4d/scene/brdf.h"

namespace lightwell {

namespace {

/// Mean over an angular cell of pi times the lobe towards a direction.
double lobe_over_cell(const Lobe& lobe, const ParameterRect& r, const Vec3& towards) {
    // The same grid over the whole square, however fine its cells are.
    constexpr double grid = 128;
    const int points = std::max(4, static_cast<int>(std::lround(grid * (r.u1 - r.u0))));
    double sum = 0;
    for (int i = 0; i < points; ++i)
        for (int j = 0; j < points; ++j)
            sum += lobe_value(lobe,
                              direction_from_square({r.u0 + (i + 0.5) / points * (r.u1 - r.u0),
                                                     r.v0 + (j + 0.5) / points * (r.v1 - r.v0)}),
                              towards);
    return M_PI * sum / (points * points);
}

}  // namespace

BrdfProduct::BrdfProduct(const Scene& scene, const RadianceSpace& space,
                         const RadianceField& incident)
    : scene_(scene), space_(space), mean_albedo_(mean_albedos(scene.materials)) {
    for (const Element& element : space.elements()) {
        frame_.push_back(local_frame(element.geometry));
        const CellTree& tree = element.space.tree();
        const auto cells = static_cast<Eigen::Index>(tree.functions());
        const auto angles = static_cast<Eigen::Index>(element.angle.functions());
        const HaarBasis angular = angular_basis(element.angle.levels());
        incident_.emplace_back();
        for (int c = 0; c < 3; ++c) {
            RowMatrix by_cell =
                Eigen::Map<const RowMatrix>(incident.col(c).data() + element.first, cells, angles);
            element.space.synthesise(by_cell, tree.levels());
            for (Eigen::Index m = 0; m < cells; ++m)
                by_cell.row(m) *=
                    std::sqrt(static_cast<double>(angles) /
                              element.space.area({tree.levels(), static_cast<std::uint32_t>(m)}));
            RowMatrix by_angle = by_cell.transpose();
            angular.synthesise(by_angle, element.angle.levels());
            incident_.back()[static_cast<std::size_t>(c)] = by_angle.transpose();
        }
    }
}

Rgb BrdfProduct::radiance(std::size_t element, std::uint32_t cell, const Vec3& direction) const {
    const Vec3 towards = frame_[element].transpose() * direction;
    if (!(towards[2] > 0)) return Rgb::Zero();
    const Element& e = space_.element(element);
    const std::array<RowMatrix, 3>& incident = incident_[element];
    Rgb mean;
    for (int c = 0; c < 3; ++c)
        mean[c] = incident[static_cast<std::size_t>(c)].row(cell).mean();
    if (e.angle.levels() == 0) return mean_albedo_[scene_.material_number(e.quad)] * mean;

    const Material& material = scene_.material_of(e.quad);
    Rgb glossy = Rgb::Zero();
    const std::uint32_t angles = e.angle.functions();
    for (std::uint32_t a = 0; a < angles; ++a) {
        const double weight =
            lobe_over_cell(material.lobe, e.angle.rect({e.angle.levels(), a}), towards) / angles;
        for (int c = 0; c < 3; ++c)
            glossy[c] += weight * incident[static_cast<std::size_t>(c)](cell, a);
    }
    return material.reflectance * mean + lobe_reflectance(material.lobe) * glossy;
}

Rgb BrdfProduct::radiance(std::size_t element, const Vec2& uv, const Vec3& direction) const {
    return radiance(element, space_.element(element).space.tree().finest_around(uv[0], uv[1]),
                    direction);
}

}  // namespace lightwell
