#include "runtime/projection/occlusion_query_projection.h"

#include <tbb/parallel_for.h>

#include "runtime/projection/light_kernel.h"

namespace lightwell {

namespace {

/// Levels below the finest: as many of those wanted as there is room for.
int finer_levels(const RadianceSpace& space, int levels) {
    constexpr std::uint64_t most_cells = std::uint64_t{1} << 18U;
    while (levels > 0 &&
           (std::uint64_t{space.functions()} << 2U * static_cast<unsigned>(levels)) > most_cells)
        --levels;
    return levels;
}

/// The same elements with so many more levels of cells.
RadianceSpace finer_space(const RadianceSpace& space, int levels) {
    std::vector<Element> elements;
    for (const Element& element : space.elements()) {
        std::vector<Split> splits = element.space.tree().splits();
        splits.insert(splits.end(), static_cast<std::size_t>(levels), Split::both);
        Element finer;
        finer.quad = element.quad;
        finer.front = element.front;
        finer.geometry = element.geometry;
        finer.set_space(CellTree(splits), {});
        elements.push_back(finer);
    }
    return RadianceSpace(elements);
}

}  // namespace

OcclusionQueryProjection::OcclusionQueryProjection(const RadianceSpace& space,
                                                   const std::vector<Quad>& quads,
                                                   const OccluderTree& occluders,
                                                   const GlLoader& loader,
                                                   const OcclusionQueryOptions& options)
    : cells_(space.elements().begin(), space.elements().end()),
      finer_(finer_levels(space, options.finer_levels)),
      finer_space_(finer_space(space, finer_)),
      finer_cells_(finer_space_.elements().begin(), finer_space_.elements().end()),
      shares_(finer_space_, finer_cells_, finer_, quads, occluders, loader, options) {
    for (const Element& element : space.elements()) {
        unoccluded_.emplace_back(std::size_t{element.space.tree().functions()}
                                 << 2U * static_cast<unsigned>(finer_));
        flux_.push_back(PackedField::Zero(4, element.space.tree().functions()));
        directed_.push_back(element.angle.levels() > 0 ? std::make_unique<DirectedCells>(element)
                                                       : nullptr);
    }
}

void OcclusionQueryProjection::project(const std::vector<Light>& lights, PackedField& direct) {
    for (PackedField& flux : flux_)
        flux.setZero();
    for (const Light& light : lights)
        add(light);
    queries_ = shares_.take_queries();
    tbb::parallel_for(std::size_t{0}, cells_.size(), [&](std::size_t e) {
        if (directed_[e])
            directed_[e]->analyse(direct);
        else
            cells_[e].analyse(flux_[e], direct);
    });
}

void OcclusionQueryProjection::add(const Light& light) {
    tbb::parallel_for(std::size_t{0}, cells_.size(), [&](std::size_t e) {
        const LightKernel kernel(light, finer_cells_[e]);
        for (std::uint32_t m = 0; m < unoccluded_[e].size(); ++m)
            unoccluded_[e][m] = kernel.height() > 0 ? kernel.flux(m) : 0;
    });
    shares_.find(position_of(light), unoccluded_);
    Packed intensity = Packed::Zero();
    intensity.head<3>() =
        std::visit([](const auto& any) { return any.intensity; }, light).cast<float>();
    tbb::parallel_for(std::size_t{0}, cells_.size(), [&](std::size_t e) {
        const std::vector<float>& share = shares_.of(e);
        for (std::uint32_t m = 0; m < share.size(); ++m)
            if (share[m] > 0)
                flux_[e].col(m >> 2U * static_cast<unsigned>(finer_)) +=
                    share[m] * unoccluded_[e][m] * intensity;
        if (!directed_[e]) return;
        directed_[e]->add(position_of(light), flux_[e]);
        flux_[e].setZero();
    });
}

}  // namespace lightwell
