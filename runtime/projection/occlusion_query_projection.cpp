#include "runtime/projection/occlusion_query_projection.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "runtime/projection/light_kernel.h"

namespace lightwell {

std::vector<Quad> OcclusionQueryProjection::parts_of(const RadianceSpace& space) {
    std::vector<Quad> parts;
    for (const Element& element : space.elements())
        for (std::uint32_t p = 0; p < element.space.tree().positions(); ++p)
            parts.push_back(element.cell(element.space.tree().at(p)));
    return parts;
}

std::vector<int> OcclusionQueryProjection::quads_of(const RadianceSpace& space) {
    std::vector<int> quads;
    for (const Element& element : space.elements())
        quads.insert(quads.end(), element.space.tree().positions(), element.quad);
    return quads;
}

OcclusionQueryProjection::OcclusionQueryProjection(const RadianceSpace& space,
                                                   const std::vector<Quad>& quads,
                                                   const GlLoader& loader,
                                                   const OcclusionQueryOptions& options)
    : options_(options), depth_(quads, parts_of(space), quads_of(space), options.side, loader) {
    std::uint32_t parts = 0;
    for (const Element& element : space.elements()) {
        cells_.emplace_back(element);
        first_part_.push_back(parts);
        parts += element.space.tree().positions();
        share_.emplace_back(element.space.tree().functions());
        flux_.push_back(PackedField::Zero(4, element.space.tree().functions()));
        directed_.push_back(element.angle.levels() > 0 ? std::make_unique<DirectedCells>(element)
                                                       : nullptr);
    }
}

void OcclusionQueryProjection::project(const std::vector<Light>& lights, PackedField& direct) {
    queries_ = 0;
    for (PackedField& flux : flux_)
        flux.setZero();
    for (const Light& light : lights) {
        find_shares(light);
        Packed intensity = Packed::Zero();
        intensity.head<3>() =
            std::visit([](const auto& any) { return any.intensity; }, light).cast<float>();
        tbb::parallel_for(std::size_t{0}, cells_.size(), [&](std::size_t e) {
            const LightKernel kernel(light, cells_[e]);
            for (std::uint32_t m = 0; m < share_[e].size(); ++m)
                if (share_[e][m] > 0) flux_[e].col(m) += share_[e][m] * kernel.flux(m) * intensity;
            if (!directed_[e]) return;
            directed_[e]->add(position_of(light), flux_[e]);
            flux_[e].setZero();
        });
    }
    tbb::parallel_for(std::size_t{0}, cells_.size(), [&](std::size_t e) {
        if (directed_[e])
            directed_[e]->analyse(direct);
        else
            cells_[e].analyse(flux_[e], direct);
    });
}

void OcclusionQueryProjection::find_shares(const Light& light) {
    depth_.look_from(position_of(light));
    level_.clear();
    for (std::size_t e = 0; e < cells_.size(); ++e) {
        std::fill(share_[e].begin(), share_[e].end(), 0.0F);
        if (cells_[e].normal().dot(position_of(light) - cells_[e].centre()) > 0)
            level_.push_back({e, {}, 1});
    }
    while (!level_.empty()) {
        look_at(level_, next_);
        level_.swap(next_);
    }
}

void OcclusionQueryProjection::look_at(const std::vector<Pending>& level,
                                       std::vector<Pending>& next) {
    next.clear();
    counted_.clear();
    for (const Pending& pending : level)
        counted_.push_back(
            {first_part_[pending.element] + cells_[pending.element].tree().position(pending.cell),
             0, 0});
    queries_ += depth_.count(counted_);
    for (std::size_t k = 0; k < level.size(); ++k) {
        const auto [element, cell, above] = level[k];
        const CellTree& tree = cells_[element].tree();
        const CountedPart& seen = counted_[k];
        // What is smaller than a pixel is as visible as what it is part of.
        const float share =
            seen.all > 0 ? static_cast<float>(seen.visible) / static_cast<float>(seen.all) : above;
        const bool is_mixed = share > 0 && share < 1;
        if (is_mixed && !tree.is_finest(cell) && seen.all >= options_.fewest_pixels) {
            for (std::uint32_t c = 0; c < tree.children(cell.level); ++c)
                next.push_back({element, tree.child(cell, c), share});
        } else {
            const std::uint32_t count = tree.functions() / tree.cells(cell.level);
            const auto first =
                share_[element].begin() + static_cast<std::ptrdiff_t>(cell.index) * count;
            std::fill(first, first + count, share);
        }
    }
}

}  // namespace lightwell
