#include "runtime/projection/visible_shares.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "radiance4d/scene/visibility.h"

namespace lightwell {

namespace {

/// An edge through a cell of n pixels is some sqrt(n) pixels long, and each of them is off by a
/// third of a pixel, or so.
constexpr double off_by = 0.3;
/// Elements that get less than this share of a lamp's flux are not looked at more closely.
constexpr double least_flux = 2e-5;
/// How often an element that is seen from near is halved, to be looked at in so many parts.
constexpr int most_halvings = 4;
/// Quarters of a cell of the basis are looked at if the light on them differs by more than this
/// share of the flux on the element.
constexpr double uneven = 2e-5;

bool is_within(const ParameterRect& inner, const ParameterRect& outer) {
    return inner.u0 >= outer.u0 && inner.u1 <= outer.u1 && inner.v0 >= outer.v0 &&
           inner.v1 <= outer.v1;
}

bool is_apart(const ParameterRect& a, const ParameterRect& b) {
    return a.u1 <= b.u0 || a.u0 >= b.u1 || a.v1 <= b.v0 || a.v0 >= b.v1;
}

double extent(const ParameterRect& rect) {
    return (rect.u1 - rect.u0) * (rect.v1 - rect.v0);
}

Quad seen_from(const Vec3& lamp, Quad quad) {
    for (Vec3& corner : quad.vertex)
        corner -= lamp;
    return quad;
}

}  // namespace

std::vector<Quad> VisibleShares::parts_of(const RadianceSpace& space) {
    std::vector<Quad> parts;
    for (const Element& element : space.elements())
        for (std::uint32_t p = 0; p < element.space.tree().positions(); ++p)
            parts.push_back(element.cell(element.space.tree().at(p)));
    return parts;
}

std::vector<int> VisibleShares::quads_of(const RadianceSpace& space) {
    std::vector<int> quads;
    for (const Element& element : space.elements())
        quads.insert(quads.end(), element.space.tree().positions(), element.quad);
    return quads;
}

VisibleShares::VisibleShares(const RadianceSpace& space, const std::vector<ElementCells>& cells,
                             int finer, const std::vector<Quad>& quads,
                             const OccluderTree& occluders, const GlLoader& loader,
                             const OcclusionQueryOptions& options)
    : options_(options),
      cells_(cells),
      finer_(finer),
      whole_flux_(cells.size()),
      occluders_(occluders),
      looked_at_(cells.size()),
      depth_(quads, parts_of(space), quads_of(space), options.side, loader) {
    std::uint32_t parts = 0;
    for (std::size_t e = 0; e < cells_.size(); ++e) {
        const Element& element = space.element(e);
        geometry_.push_back(element.geometry);
        quad_.push_back(element.quad);
        first_part_.push_back(parts);
        parts += element.space.tree().positions();
        looked_at_[e].share.resize(element.space.tree().functions());
        looked_at_[e].mixed.resize(element.space.tree().functions());
    }
}

std::uint64_t VisibleShares::take_queries() {
    return std::exchange(queries_, 0);
}

void VisibleShares::find(const Vec3& lamp, const std::vector<std::vector<float>>& flux) {
    flux_ = &flux;
    for (std::size_t e = 0; e < cells_.size(); ++e)
        whole_flux_[e] = std::accumulate(flux[e].begin(), flux[e].end(), 0.0);
    look_round(lamp);
    double all = 0;
    for (std::size_t e = 0; e < cells_.size(); ++e)
        all += lit_flux(e, flux[e]);
    for (int look = 0; look < options_.most_looks; ++look) {
        uncertain_.clear();
        for (std::size_t e = 0; e < cells_.size(); ++e) {
            LookedAt& element = looked_at_[e];
            if (element.pixels == 0 || !is_uncertain(e, flux[e], all)) continue;
            const ParameterRect rect = look == 0 ? ParameterRect{0, 1, 0, 1} : lit_rect(e);
            if (look > 0 && extent(rect) > 0.5 * extent(element.rect)) continue;
            element.rect = rect;
            uncertain_.push_back(e);
        }
        if (uncertain_.empty()) return;
        look_closer(lamp, uncertain_);
    }
}

bool VisibleShares::has_something_before(std::size_t element, const Vec3& lamp) {
    occluders_.collect(region_between(lamp, ConvexPolygon(geometry_[element])), quad_[element],
                       free_point, before_);
    return !before_.empty();
}

void VisibleShares::look_round(const Vec3& lamp) {
    level_.clear();
    for (std::size_t e = 0; e < cells_.size(); ++e) {
        const bool faces = cells_[e].normal().dot(lamp - cells_[e].centre()) > 0;
        const bool is_open = faces && !has_something_before(e, lamp);
        looked_at_[e].pixels = 0;
        looked_at_[e].rect = {0, 1, 0, 1};
        fill(e, {}, is_open ? 1 : 0, 0);
        if (faces && !is_open) level_.push_back({e, {}, 1, CountedPart::all_views});
    }
    if (level_.empty()) return;
    const auto faces = cube_views();
    depth_.look_from(lamp, {faces.begin(), faces.end()});
    while (!level_.empty())
        look_at_level();
}

void VisibleShares::look_closer(const Vec3& lamp, const std::vector<std::size_t>& elements) {
    closer_.clear();
    for (const std::size_t e : elements) {
        looked_at_[e].pixels = 0;
        plan(lamp, e, looked_at_[e].rect, most_halvings);
    }
    for (std::size_t first = 0; first < closer_.size(); first += LampDepth::most_views) {
        const std::size_t count = std::min(closer_.size() - first, LampDepth::most_views);
        views_.clear();
        for (std::size_t k = 0; k < count; ++k) {
            const Closer& closer = closer_[first + k];
            views_.push_back(closer.view);
            add_cells_within(closer.rect, {}, {closer.element, {}, 0, static_cast<int>(k)});
        }
        depth_.look_from(lamp, views_);
        while (!level_.empty())
            look_at_level();
    }
}

void VisibleShares::plan(const Vec3& lamp, std::size_t element, const ParameterRect& rect,
                         int halvings) {
    const Quad part = seen_from(lamp, geometry_[element].part(rect.u0, rect.u1, rect.v0, rect.v1));
    if (const auto view = close_view(part, 2.0 / options_.side)) {
        closer_.push_back({element, rect, *view});
        return;
    }
    const CellTree& tree = cells_[element].tree();
    const double columns = std::round((rect.u1 - rect.u0) * tree.columns());
    const double rows = std::round((rect.v1 - rect.v0) * tree.rows());
    // What is seen from too near even so is what the cube has made of it.
    if (halvings == 0 || (columns < 2 && rows < 2)) return;
    ParameterRect low = rect, high = rect;
    if (columns >= rows)
        low.u1 = high.u0 = rect.u0 + std::floor(columns / 2) / tree.columns();
    else
        low.v1 = high.v0 = rect.v0 + std::floor(rows / 2) / tree.rows();
    plan(lamp, element, low, halvings - 1);
    plan(lamp, element, high, halvings - 1);
}

void VisibleShares::add_cells_within(const ParameterRect& rect, const Cell& cell,
                                     const Pending& like) {
    const CellTree& tree = cells_[like.element].tree();
    if (is_apart(tree.rect(cell), rect)) return;
    if (is_within(tree.rect(cell), rect)) {
        level_.push_back({like.element, cell, like.share, like.view});
        return;
    }
    for (std::uint32_t c = 0; c < tree.children(cell.level); ++c)
        add_cells_within(rect, tree.child(cell, c), like);
}

void VisibleShares::look_at_level() {
    next_.clear();
    counted_.clear();
    for (const Pending& pending : level_) {
        const CellTree& tree = cells_[pending.element].tree();
        counted_.push_back(
            {first_part_[pending.element] + tree.position(pending.cell), pending.view, 0, 0});
    }
    queries_ += depth_.count(counted_);
    for (std::size_t k = 0; k < level_.size(); ++k)
        settle(level_[k], counted_[k]);
    level_.swap(next_);
}

void VisibleShares::settle(const Pending& pending, const CountedPart& seen) {
    const auto& [element, cell, above, view] = pending;
    const CellTree& tree = cells_[element].tree();
    // What is smaller than a pixel is as visible as what it is part of.
    const float share =
        seen.all > 0 ? static_cast<float>(seen.visible) / static_cast<float>(seen.all) : above;
    const bool is_mixed = share > 0 && share < 1;
    if (is_mixed && seen.all >= options_.fewest_pixels && is_worth_splitting(element, cell)) {
        for (std::uint32_t c = 0; c < tree.children(cell.level); ++c)
            next_.push_back({element, tree.child(cell, c), share, view});
        return;
    }
    looked_at_[element].pixels += seen.all;
    fill(element, cell, share, is_mixed ? std::max(seen.all, 1U) : 0);
}

bool VisibleShares::is_worth_splitting(std::size_t element, const Cell& cell) const {
    const CellTree& tree = cells_[element].tree();
    if (tree.is_finest(cell)) return false;
    if (cell.level < tree.levels() - finer_) return true;
    // Pixels of a cell count alike; what that is wrong by is less than its quarters differ.
    const std::uint32_t count = tree.functions() / tree.cells(cell.level) / 4;
    auto at = (*flux_)[element].begin() + static_cast<std::ptrdiff_t>(4 * cell.index) * count;
    double least = whole_flux_[element], most = 0;
    for (int quarter = 0; quarter < 4; ++quarter, at += count) {
        const double flux = std::accumulate(at, at + count, 0.0);
        least = std::min(least, flux);
        most = std::max(most, flux);
    }
    return most - least > uneven * whole_flux_[element];
}

void VisibleShares::fill(std::size_t element, const Cell& cell, float share, std::uint32_t mixed) {
    const CellTree& tree = cells_[element].tree();
    const std::uint32_t count = tree.functions() / tree.cells(cell.level);
    const auto first = static_cast<std::ptrdiff_t>(cell.index) * count;
    LookedAt& to = looked_at_[element];
    std::fill_n(to.share.begin() + first, count, share);
    std::fill_n(to.mixed.begin() + first, count, mixed);
}

double VisibleShares::lit_flux(std::size_t element, const std::vector<float>& flux) const {
    const std::vector<float>& share = looked_at_[element].share;
    double sum = 0;
    for (std::size_t m = 0; m < share.size(); ++m)
        sum += static_cast<double>(share[m] * flux[m]);
    return sum;
}

bool VisibleShares::is_uncertain(std::size_t element, const std::vector<float>& flux,
                                 double all) const {
    const LookedAt& seen = looked_at_[element];
    double lit = 0, open = 0, whole = 0;
    for (std::size_t m = 0; m < flux.size(); ++m) {
        const auto here = static_cast<double>(flux[m]);
        whole += here;
        lit += static_cast<double>(seen.share[m]) * here;
        if (seen.mixed[m] > 0) open += here / std::sqrt(static_cast<double>(seen.mixed[m]));
    }
    // Narrower than a pixel, light or shadow may stand along an edge of the whole unseen.
    const double unseen = 1 / std::sqrt(static_cast<double>(seen.pixels));
    if (!(lit > 0)) return off_by * unseen * whole > least_flux * all;
    return lit > least_flux * all && off_by * (open + unseen * lit) > options_.error * lit;
}

ParameterRect VisibleShares::lit_rect(std::size_t element) const {
    const CellTree& tree = cells_[element].tree();
    const LookedAt& seen = looked_at_[element];
    ParameterRect lit{1, 0, 1, 0};
    for (std::uint32_t m = 0; m < tree.functions(); ++m) {
        if (!(seen.share[m] > 0)) continue;
        const ParameterRect cell = tree.rect({tree.levels(), m});
        lit = {std::min(lit.u0, cell.u0), std::max(lit.u1, cell.u1), std::min(lit.v0, cell.v0),
               std::max(lit.v1, cell.v1)};
    }
    if (!(lit.u0 < lit.u1)) return seen.rect;
    const double u = 1.0 / tree.columns(), v = 1.0 / tree.rows();
    return {std::max(0.0, lit.u0 - u), std::min(1.0, lit.u1 + u), std::max(0.0, lit.v0 - v),
            std::min(1.0, lit.v1 + v)};
}

}  // namespace lightwell
