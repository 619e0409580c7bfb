#include "viewer/stability/projected_scene.h"

#include <cmath>

#include "radiance4d/operator/light_projection.h"
#include "runtime/projection/shadow_projection.h"

namespace lightwell::stability {

namespace {

RadianceSpace space_on(const std::vector<Quad>& quads, double cell) {
    constexpr int most_levels = 9;
    std::vector<Element> elements;
    for (const Quad& quad : quads) {
        Element element;
        element.quad = static_cast<int>(elements.size());
        element.geometry = quad;
        const auto& p = quad.vertex;
        element.space = HaarBasis(
            quad, tree_for_extents((p[1] - p[0]).norm(), (p[3] - p[0]).norm(), cell, most_levels));
        elements.push_back(element);
    }
    return RadianceSpace(std::move(elements));
}

}  // namespace

ProjectedScene::ProjectedScene(const std::vector<Quad>& quads, double cell)
    : quads_(quads), space_(space_on(quads, cell)), occluders_(quads) {}

RadianceField ProjectedScene::measured(const std::vector<Light>& lights) const {
    return projected_lights(space_, lights, quads_, occluders_);
}

RadianceField ProjectedScene::drawn(const std::vector<Light>& lights) const {
    ShadowProjection projection(space_, quads_, occluders_);
    PackedField field = PackedField::Zero(4, space_.functions());
    projection.project(lights, field);
    return unpacked(field);
}

Eigen::ArrayXd ProjectedScene::cells(std::size_t quad, const RadianceField& field) const {
    return cell_irradiance(space_, quad, field).col(0);
}

double ProjectedScene::flux(std::size_t quad, const RadianceField& field) const {
    const Element& element = space_.element(quad);
    return M_PI * std::sqrt(element.area()) * field(element.first, 0);
}

double ProjectedScene::flux(const RadianceField& field) const {
    return total_flux(space_, field)[0];
}

}  // namespace lightwell::stability
