#include "solver/radiance_bounce.h"

#include "radiance4d/scene/brdf.h"
#include "solver/series/bounce_truncation.h"
#include "solver/transport/closure.h"
#include "solver/transport/directed_transport.h"
#include "solver/transport/elements.h"
#include "solver/transport/open_masks.h"
#include "solver/transport/refiner.h"

namespace lightwell {

namespace {

constexpr int most_space_levels = 9;

/// Gives the sides of glossy materials their angular cells.
void set_angles(const Scene& scene, const AngularResolution& resolution,
                std::vector<Element>& elements) {
    std::vector<int> level;
    for (const Material& material : scene.materials)
        level.push_back(is_glossy(material) ? AngularReflection(material.lobe, resolution).level()
                                            : 0);
    for (Element& element : elements) {
        const std::size_t material = scene.material_number(element.quad);
        if (element.front || scene.materials[material].reflecting == Sides::both)
            element.angle = angular_basis(level[material]).tree();
    }
}

}  // namespace

std::vector<AngularNeed> angular_needs(const Scene& scene, const AngularResolution& resolution) {
    std::vector<AngularNeed> needs;
    for (const Material& material : scene.materials) {
        if (!is_glossy(material)) continue;
        const AngularReflection reflection(material.lobe, resolution);
        needs.push_back(
            {material.name, reflection.level(), reflection.error(), reflection.follows()});
    }
    return needs;
}

RadianceBounce radiance_bounce(const Ground& ground, const RadianceBounceOptions& options,
                               const Progress& progress) {
    // 1. Elements, their cells in space and direction, and what of them is open.
    OracleCost cost;
    std::vector<Element> elements = ground.elements;
    set_cells(elements, options.cell_size, most_space_levels);
    set_angles(ground.scene, options.angle, elements);
    set_open_masks(ground.quads, ground.occluders, ground.visibility, elements, cost);
    double area = 0;
    for (const Element& element : elements)
        area += element.area();

    // 2. Links in space, with the energy that closed sides exchange.
    const GeometricOracle oracle(options.oracle, ground.quads, ground.visibility, area);
    std::vector<PairLinks> pairs =
        refine_links(elements, ground.quads, ground.occluders, oracle, progress, cost);
    close_links(elements, ground.closed, {}, pairs, progress);

    // 3. Links with directions wherever a side is glossy.
    std::vector<DirectedPair> directed =
        directed_links(elements, pairs, ground.visibility, options.directions, progress, cost);
    RadianceBounce bounce;
    bounce.directions_off = close_directions(elements, ground.closed, directed);
    for (const DirectedPair& pair : directed)
        for (const DirectedLink& link : pair.links)
            ++(link.sampled ? bounce.directed_links : bounce.links);
    bounce.rays = cost.rays;

    // 4. The operator in wavelets.
    bounce.space = RadianceSpace(std::move(elements));
    bounce.propagation =
        BounceTruncation(bounce.space, ground.closed,
                         directed_transport(bounce.space, directed, progress),
                         Eigen::ArrayXd::Ones(static_cast<Eigen::Index>(bounce.space.functions())))
            .at(0);
    return bounce;
}

}  // namespace lightwell
