#include "radiance4d/basis/radiance_space.h"

#include <algorithm>
#include <bitset>
#include <limits>
#include <utility>

namespace lightwell {

Quad Element::cell(const Cell& cell) const {
    const ParameterRect r = space.tree().rect(cell);
    return geometry.part(r.u0, r.u1, r.v0, r.v1);
}

bool Element::is_open(double u, double v) const {
    if (open.empty()) return true;
    const CellTree& tree = space.tree();
    const double x = std::clamp(u, 0.0, 1.0) * tree.columns();
    const double y = std::clamp(v, 0.0, 1.0) * tree.rows();
    const std::uint32_t column = std::min(static_cast<std::uint32_t>(x), tree.columns() - 1);
    const std::uint32_t row = std::min(static_cast<std::uint32_t>(y), tree.rows() - 1);
    const unsigned i = std::min(static_cast<unsigned>(8 * (x - column)), 7U);
    const unsigned j = std::min(static_cast<unsigned>(8 * (y - row)), 7U);
    return ((open[tree.finest_at(column, row)] >> (8 * j + i)) & 1U) != 0;
}

void Element::set_space(const CellTree& tree, std::vector<OpenMask> masks) {
    open = std::move(masks);
    std::vector<double> share;
    for (const OpenMask mask : open) {
        // A cell that is buried altogether keeps its area: what little arrives there is its mean.
        const auto count = static_cast<double>(std::bitset<64>(mask).count());
        share.push_back(count == 0 ? 1 : count / 64);
    }
    space = HaarBasis(geometry, tree, share);
}

RadianceSpace::RadianceSpace(std::vector<Element> elements) : elements_(std::move(elements)) {
    std::uint64_t next = 0;
    for (std::size_t e = 0; e < elements_.size(); ++e) {
        Element& element = elements_[e];
        element.first = static_cast<std::uint32_t>(next);
        next += element.functions();
        if (next > std::numeric_limits<std::uint32_t>::max())
            throw InputError(
                "the scene needs more than 4294967295 basis functions; ask for a larger error");
        area_ += element.area();
        const auto side = 2 * static_cast<std::size_t>(element.quad) + (element.front ? 0 : 1);
        if (by_side_.size() <= side) by_side_.resize(side + 2, -1);
        by_side_[side] = static_cast<int>(e);
    }
    functions_ = static_cast<std::uint32_t>(next);
}

std::size_t RadianceSpace::element_of(std::uint32_t function) const {
    const auto after = std::upper_bound(
        elements_.begin(), elements_.end(), function,
        [](std::uint32_t wanted, const Element& element) { return wanted < element.first; });
    return static_cast<std::size_t>(after - elements_.begin()) - 1;
}

int RadianceSpace::element_on(int quad, bool front) const {
    const auto side = 2 * static_cast<std::size_t>(quad) + (front ? 0 : 1);
    return side < by_side_.size() ? by_side_[side] : -1;
}

}  // namespace lightwell
