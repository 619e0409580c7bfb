#include "radiance4d/operator/light_projection.h"

#include <cmath>

#include <tbb/parallel_for.h>

#include "radiance4d/operator/directed_light.h"
#include "radiance4d/scene/light_flux.h"
#include "radiance4d/scene/visibility.h"
#include "radiance4d/scene/visible_part.h"

namespace lightwell {

namespace {

/// Projects one light on one element.
class ElementProjection {
  public:
    ElementProjection(const Element& element, const Light& light, const std::vector<Quad>& quads,
                      RadianceField& irradiance)
        : element_(element),
          light_(light),
          quads_(quads),
          position_(position_of(light)),
          irradiance_(irradiance) {}

    /// Adds the light on all finest cells below `cell`; `occluders` may stand before it.
    void visit(const Cell& cell, const std::vector<int>& occluders) {
        const CellTree& tree = element_.space.tree();
        const ConvexPolygon polygon(element_.cell(cell));
        std::vector<int> narrowed;
        if (!occluders.empty()) {
            const ConvexRegion region = region_between(position_, polygon);
            for (const int quad : occluders)
                if (!region.misses(quads_[static_cast<std::size_t>(quad)]))
                    narrowed.push_back(quad);
        }
        if (tree.is_finest(cell)) {
            const Rgb through =
                narrowed.empty() ? flux(light_, polygon)
                                 : flux(light_, visible_part(position_, polygon, quads_, narrowed));
            irradiance_.row(cell.index) += (through / element_.space.area(cell)).transpose();
            return;
        }
        for (std::uint32_t c = 0; c < tree.children(cell.level); ++c)
            visit(tree.child(cell, c), narrowed);
    }

  private:
    const Element& element_;
    const Light& light_;
    const std::vector<Quad>& quads_;
    const Vec3& position_;
    RadianceField& irradiance_;
};

}  // namespace

RadianceField projected_lights(const RadianceSpace& space, const std::vector<Light>& lights,
                               const std::vector<Quad>& quads, const OccluderTree& occluders) {
    RadianceField field = RadianceField::Zero(space.functions(), 3);
    tbb::parallel_for(std::size_t{0}, space.elements().size(), [&](std::size_t e) {
        const Element& element = space.element(e);
        const bool directed = element.angle.levels() > 0;
        RadianceField irradiance = RadianceField::Zero(element.space.tree().functions(), 3);
        const Vec3 normal = element.geometry.normal();
        bool lit = false;
        std::vector<int> found;
        for (const Light& light : lights) {
            if (!(normal.dot(position_of(light) - element.geometry.vertex[0]) > 0)) continue;
            lit = true;
            occluders.collect(region_between(position_of(light), ConvexPolygon(element.geometry)),
                              element.quad, free_point, found);
            ElementProjection(element, light, quads, irradiance).visit({}, found);
            if (!directed) continue;
            add_directed_light(element, position_of(light), irradiance, field);
            irradiance.setZero();
        }
        if (lit && !directed) set_cell_irradiance(space, e, irradiance, field);
    });
    return field;
}

}  // namespace lightwell
