#include "runtime/outgoing/glossy_product.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "radiance4d/basis/direction_map.h"
#include "radiance4d/scene/brdf.h"

namespace lightwell {

GlossyProduct::GlossyProduct(const Scene& scene, const RadianceSpace& space,
                             const RadianceField& incident)
    : scene_(scene), space_(space), incident_(space.elements().size()) {
    std::map<std::pair<std::size_t, int>, int> known;  // material and level -> table
    for (std::size_t e = 0; e < space.elements().size(); ++e) {
        const Element& element = space.element(e);
        frame_.push_back(local_frame(element.geometry));
        lobe_.push_back(-1);
        const int level = element.angle.levels();
        if (level == 0) continue;
        const std::size_t material = scene.material_number(element.quad);
        const auto [entry, is_new] =
            known.try_emplace({material, level}, static_cast<int>(tables_.size()));
        if (is_new) tables_.emplace_back(scene.materials[material].lobe, level);
        lobe_.back() = entry->second;

        const CellTree& tree = element.space.tree();
        const auto cells = static_cast<Eigen::Index>(tree.functions());
        const auto angles = static_cast<Eigen::Index>(element.angle.functions());
        incident_[e].resize(cells * angles, 3);
        for (int c = 0; c < 3; ++c) {
            RowMatrix by_cell =
                Eigen::Map<const RowMatrix>(incident.col(c).data() + element.first, cells, angles);
            element.space.synthesise(by_cell, tree.levels());
            for (Eigen::Index m = 0; m < cells; ++m) {
                const double area =
                    element.space.area({tree.levels(), static_cast<std::uint32_t>(m)});
                incident_[e].middleRows(m * angles, angles).col(c) =
                    (by_cell.row(m) / std::sqrt(area)).transpose().array().cast<float>();
            }
        }
    }
}

GlossyProduct::Parts GlossyProduct::of_cell(std::size_t element, std::uint32_t cell,
                                            const Vec3& towards) const {
    const Material& material = scene_.material_of(space_.element(element).quad);
    const auto angles = static_cast<Eigen::Index>(space_.element(element).angle.functions());
    const auto incident = incident_[element].middleRows(cell * angles, angles);
    return {material.reflectance * incident.row(0).transpose().cast<double>(),
            lobe_reflectance(material.lobe) *
                tables_[static_cast<std::size_t>(lobe_[element])].reflected(towards, incident)};
}

GlossyProduct::Parts GlossyProduct::between_cells(std::size_t element, const Vec2& uv,
                                                  const Vec3& direction) const {
    Parts sum;
    const Vec3 towards = frame_[element].transpose() * direction;
    if (!(towards[2] > 0)) return sum;
    const Element& e = space_.element(element);
    const CellTree& tree = e.space.tree();
    const auto columns = static_cast<int>(tree.columns()), rows = static_cast<int>(tree.rows());
    const double x = std::clamp(uv[0] * columns - 0.5, 0.0, columns - 1.0);
    const double y = std::clamp(uv[1] * rows - 0.5, 0.0, rows - 1.0);
    const int left = std::min(static_cast<int>(x), std::max(0, columns - 2));
    const int low = std::min(static_cast<int>(y), std::max(0, rows - 2));
    double shares = 0;
    for (int j = low; j <= std::min(low + 1, rows - 1); ++j)
        for (int i = left; i <= std::min(left + 1, columns - 1); ++i) {
            const double share = (1 - std::abs(x - i)) * (1 - std::abs(y - j));
            const std::uint32_t cell =
                tree.finest_at(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
            // What is buried sees nothing and is not seen.
            if (!(share > 0) || (!e.open.empty() && e.open[cell] == 0)) continue;
            const Parts parts = of_cell(element, cell, towards);
            sum.diffuse += share * parts.diffuse;
            sum.lobe += share * parts.lobe;
            shares += share;
        }
    if (!(shares > 0)) return sum;
    return {sum.diffuse / shares, sum.lobe / shares};
}

Rgb GlossyProduct::radiance(std::size_t element, const Vec2& uv, const Vec3& direction) const {
    const Parts parts = between_cells(element, uv, direction);
    return parts.diffuse + parts.lobe;
}

Rgb GlossyProduct::from_lobe(std::size_t element, const Vec2& uv, const Vec3& direction) const {
    return between_cells(element, uv, direction).lobe;
}

}  // namespace lightwell
