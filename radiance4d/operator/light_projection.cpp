#include "radiance4d/operator/light_projection.h"

#include <cmath>
#include <utility>

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

    /// Adds the light on all finest cells; `occluders` may stand before them.
    void run(const std::vector<int>& occluders) {
        std::vector<Occluder> all;
        all.reserve(occluders.size());
        for (const int quad : occluders) {
            const Quad& occluder = quads_[static_cast<std::size_t>(quad)];
            all.push_back({&occluder, Shadow(position_, occluder)});
        }
        std::vector<const Occluder*> before;
        before.reserve(all.size());
        for (const Occluder& occluder : all)
            if (!occluder.shadow.empty()) before.push_back(&occluder);
        visit({}, before);
    }

  private:
    struct Occluder {
        const Quad* quad;
        Shadow shadow;
    };

    void visit(const Cell& cell, const std::vector<const Occluder*>& occluders) {
        const CellTree& tree = element_.space.tree();
        const ConvexPolygon polygon(element_.cell(cell));
        // In a building a single wall hides most of what lies behind it.
        for (const Occluder* occluder : occluders)
            if (hides_all(occluder->shadow, polygon)) return;
        std::vector<const Occluder*> narrowed;
        if (!occluders.empty()) {
            const ConvexRegion region = region_between(position_, polygon);
            for (const Occluder* occluder : occluders)
                if (!region.misses(*occluder->quad)) narrowed.push_back(occluder);
        }
        if (tree.is_finest(cell)) {
            irradiance_.row(cell.index) +=
                (flux_past(narrowed, polygon) / element_.space.area(cell)).transpose();
            return;
        }
        for (std::uint32_t c = 0; c < tree.children(cell.level); ++c)
            visit(tree.child(cell, c), narrowed);
    }

    Rgb flux_past(const std::vector<const Occluder*>& occluders, const ConvexPolygon& polygon) {
        if (occluders.empty()) return flux(light_, polygon);
        std::vector<Shadow> shadows;
        shadows.reserve(occluders.size());
        for (const Occluder* occluder : occluders)
            shadows.push_back(occluder->shadow);
        return flux(light_, visible_part(position_, polygon, std::move(shadows)));
    }

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
            ElementProjection(element, light, quads, irradiance).run(found);
            if (!directed) continue;
            add_directed_light(element, position_of(light), irradiance, field);
            irradiance.setZero();
        }
        if (lit && !directed) set_cell_irradiance(space, e, irradiance, field);
    });
    return field;
}

}  // namespace lightwell
