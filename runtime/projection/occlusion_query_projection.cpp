#include "runtime/projection/occlusion_query_projection.h"

#include <tbb/parallel_for.h>

#include "runtime/projection/light_kernel.h"

namespace lightwell {

OcclusionQueryProjection::OcclusionQueryProjection(const RadianceSpace& space,
                                                   const std::vector<Quad>& quads,
                                                   const OccluderTree& occluders,
                                                   const GlLoader& loader,
                                                   const OcclusionQueryOptions& options)
    : cells_(space.elements().begin(), space.elements().end()),
      shares_(space, cells_, quads, occluders, loader, options) {
    for (const Element& element : space.elements()) {
        unoccluded_.emplace_back(element.space.tree().functions());
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
        const LightKernel kernel(light, cells_[e]);
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
            if (share[m] > 0) flux_[e].col(m) += share[m] * unoccluded_[e][m] * intensity;
        if (!directed_[e]) return;
        directed_[e]->add(position_of(light), flux_[e]);
        flux_[e].setZero();
    });
}

}  // namespace lightwell
