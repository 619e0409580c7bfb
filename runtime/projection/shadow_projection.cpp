#include "runtime/projection/shadow_projection.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include <tbb/parallel_for.h>

#include "radiance4d/scene/visibility.h"
#include "runtime/projection/directed_cells.h"
#include "runtime/projection/edge_shares.h"
#include "runtime/projection/light_kernel.h"
#include "runtime/projection/shadow_planes.h"

namespace lightwell {

namespace {

/// How near to a shadow's plane a corner may lie and count as on it, relative to the element: a few
/// roundings of its coordinates.
constexpr double relative_tolerance = 2e-6;

constexpr int fewest_cuts = 3, most_cuts = EdgeShares::most_cuts;

/// How often cells that several edges run through must be cut in four for a given error of their
/// visible share: the quarters that still hold several shrink along the edges at best by half.
int cuts_for(double error) {
    int cuts = fewest_cuts;
    while (cuts < most_cuts && 0.15 * std::exp2(-cuts) > error)
        ++cuts;
    return cuts;
}

}  // namespace

struct ShadowProjection::Scratch {
    struct EdgeCell {
        std::uint32_t finest;
        std::size_t begin, end;  ///< its shadows, in edge_shadows
        float unoccluded;        ///< flux with nothing between, for 1 cd [lm]
    };
    PackedField flux;                         ///< of an element's finest cells
    std::unique_ptr<DirectedCells> directed;  ///< of a glossy element
    std::vector<int> found;                   ///< quads before an element
    std::vector<ShadowPlanes> planes;         ///< of these
    std::vector<std::uint32_t> pending;  ///< shadows of the cells being looked at, innermost last
    std::vector<EdgeCell> edge_cells;
    std::vector<std::uint32_t> edge_shadows;
    ShadowProjectionReport report;
};

/// One lamp on one element.
class ShadowProjection::ElementVisit {
  public:
    ElementVisit(const ElementCells& cells, const LightKernel& kernel, const Rgb& intensity,
                 Scratch& scratch)
        : cells_(cells),
          kernel_(kernel),
          scratch_(scratch),
          tolerance_(static_cast<float>(relative_tolerance * cells.extent())),
          shares_(cells, kernel, scratch.planes, tolerance_, scratch.report.rays) {
        intensity_.head<3>() = intensity.cast<float>();
    }

    /// Adds the lamp's flux on all finest cells, past scratch.planes.
    void run(double edge_error) {
        scratch_.pending.resize(scratch_.planes.size());
        std::iota(scratch_.pending.begin(), scratch_.pending.end(), 0U);
        scratch_.edge_cells.clear();
        scratch_.edge_shadows.clear();
        visit({}, 0);
        // Most are settled at once; the others share what error the element may have.
        std::size_t unsettled = 0;
        double uncertain = 0;
        for (const Scratch::EdgeCell& edge : scratch_.edge_cells) {
            const std::uint64_t rays_before = scratch_.report.rays;
            const EdgeShares::Share share = visible_share(edge, 0);
            if (scratch_.report.rays == rays_before) {
                add_share(edge, share);
            } else {
                uncertain += static_cast<double>(edge.unoccluded);
                lit_ += static_cast<double>(edge.unoccluded * share.ratio());
                scratch_.edge_cells[unsettled++] = edge;
            }
        }
        const int cuts = cuts_for(edge_error * lit_ / uncertain);
        for (std::size_t k = 0; k < unsettled; ++k)
            add_share(scratch_.edge_cells[k], visible_share(scratch_.edge_cells[k], cuts));
    }

  private:
    void add(std::uint32_t finest, float unit_flux) {
        scratch_.flux.col(finest) += unit_flux * intensity_;
    }

    /// Looks at a cell that the shadows pending[begin ..] may reach.
    void visit(const Cell& cell, std::size_t begin) {
        const CellTree& tree = cells_.tree();
        const FourPoints& corners = cells_.corners(tree.position(cell));
        const std::size_t end = scratch_.pending.size();
        bool is_dark = false;
        for (std::size_t k = begin; k < end && !is_dark; ++k) {
            const std::uint32_t number = scratch_.pending[k];
            const Cover cover = scratch_.planes[number].cover(corners, tolerance_);
            is_dark = cover == Cover::all;
            if (cover == Cover::part) scratch_.pending.push_back(number);
        }
        if (!is_dark) {
            if (scratch_.pending.size() == end)
                light_all(cell);
            else if (tree.is_finest(cell))
                keep_edge(cell.index, end);
            else
                for (std::uint32_t c = 0; c < tree.children(cell.level); ++c)
                    visit(tree.child(cell, c), end);
        }
        scratch_.pending.resize(end);
    }

    void light_all(const Cell& cell) {
        const CellTree& tree = cells_.tree();
        const std::uint32_t count = tree.functions() / tree.cells(cell.level);
        for (std::uint32_t m = cell.index * count; m < (cell.index + 1) * count; ++m) {
            const float flux = kernel_.flux(m);
            lit_ += static_cast<double>(flux);
            add(m, flux);
        }
        scratch_.report.lit_cells += count;
    }

    void keep_edge(std::uint32_t finest, std::size_t begin) {
        const float unoccluded = kernel_.flux(finest);
        if (!(unoccluded > 0)) return;
        const std::size_t first = scratch_.edge_shadows.size();
        scratch_.edge_shadows.insert(scratch_.edge_shadows.end(),
                                     scratch_.pending.begin() + static_cast<std::ptrdiff_t>(begin),
                                     scratch_.pending.end());
        ++scratch_.report.edge_cells;
        scratch_.edge_cells.push_back({finest, first, scratch_.edge_shadows.size(), unoccluded});
    }

    EdgeShares::Share visible_share(const Scratch::EdgeCell& edge, int cuts) {
        const std::uint32_t position =
            cells_.tree().position({cells_.tree().levels(), edge.finest});
        return shares_.of(cells_.corners(position), scratch_.edge_shadows.data() + edge.begin,
                          scratch_.edge_shadows.data() + edge.end, cuts);
    }

    void add_share(const Scratch::EdgeCell& edge, const EdgeShares::Share& share) {
        const float flux = edge.unoccluded * share.ratio();
        lit_ += static_cast<double>(flux);
        add(edge.finest, flux);
    }

    const ElementCells& cells_;
    const LightKernel& kernel_;
    Scratch& scratch_;
    float tolerance_;
    EdgeShares shares_;
    Packed intensity_ = Packed::Zero();
    double lit_ = 0;  ///< flux on cells that see all of the lamp, for 1 cd [lm]
};

ShadowProjection::ShadowProjection(const RadianceSpace& space, std::vector<Quad> quads,
                                   const OccluderTree& occluders,
                                   const ShadowProjectionOptions& options)
    : quads_(std::move(quads)), occluders_(occluders), options_(options) {
    LIGHTWELL_CHECK_OP(occluders.quad_count(), ==, static_cast<int>(quads_.size()));
    for (const Element& element : space.elements()) {
        cells_.emplace_back(element);
        quad_of_.push_back(element.quad);
        scratch_.emplace_back();
        scratch_.back().flux = PackedField::Zero(4, element.space.tree().functions());
        if (element.angle.levels() > 0)
            scratch_.back().directed = std::make_unique<DirectedCells>(element);
    }
    order_.resize(cells_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
        return cells_[a].tree().functions() > cells_[b].tree().functions();
    });
}

ShadowProjection::~ShadowProjection() = default;

void ShadowProjection::project(const std::vector<Light>& lights, PackedField& direct) {
    shadows_.resize(std::max(shadows_.size(), lights.size()));
    for (std::size_t l = 0; l < lights.size(); ++l) {
        shadows_[l].clear();
        for (const Quad& quad : quads_)
            shadows_[l].emplace_back(position_of(lights[l]), quad);
    }
    tbb::parallel_for(
        std::size_t{0}, order_.size(),
        [&](std::size_t k) {
            const std::size_t e = order_[k];
            const ElementCells& cells = cells_[e];
            Scratch& scratch = scratch_[e];
            scratch.report = {};
            scratch.flux.setZero();
            for (std::size_t l = 0; l < lights.size(); ++l) {
                const LightKernel kernel(lights[l], cells);
                if (!(kernel.height() > 0)) continue;
                const Quad quad = quads_[static_cast<std::size_t>(quad_of_[e])];
                occluders_.collect(region_between(position_of(lights[l]), ConvexPolygon(quad)),
                                   quad_of_[e], free_point, scratch.found);
                scratch.planes.clear();
                for (const int found : scratch.found) {
                    const Shadow& shadow = shadows_[l][static_cast<std::size_t>(found)];
                    if (!shadow.empty()) scratch.planes.emplace_back(shadow, cells.centre());
                }
                const Rgb intensity =
                    std::visit([](const auto& any) { return any.intensity; }, lights[l]);
                ElementVisit(cells, kernel, intensity, scratch).run(options_.edge_error);
                if (!scratch.directed) continue;
                scratch.directed->add(position_of(lights[l]), scratch.flux);
                scratch.flux.setZero();
            }
            if (scratch.directed)
                scratch.directed->analyse(direct);
            else
                cells.analyse(scratch.flux, direct);
        },
        tbb::simple_partitioner());
    report_ = {};
    for (const Scratch& scratch : scratch_) {
        report_.lit_cells += scratch.report.lit_cells;
        report_.edge_cells += scratch.report.edge_cells;
        report_.rays += scratch.report.rays;
    }
}

}  // namespace lightwell
