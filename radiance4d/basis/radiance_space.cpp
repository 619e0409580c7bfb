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

namespace {

/// Number of the mask sample that a parameter falls on, along a side of so many cells.
int sample_number(double at, std::uint32_t cells) {
    return std::clamp(static_cast<int>(8 * at * cells), 0, static_cast<int>(8 * cells) - 1);
}

bool bit_at(const Element& element, int x, int y) {
    const OpenMask mask = element.open[element.space.tree().finest_at(
        static_cast<std::uint32_t>(x / 8), static_cast<std::uint32_t>(y / 8))];
    return ((mask >> (8 * (y % 8) + x % 8)) & 1U) != 0;
}

}  // namespace

bool Element::is_sample_open(double u, double v) const {
    if (open.empty()) return true;
    const CellTree& tree = space.tree();
    return bit_at(*this, sample_number(u, tree.columns()), sample_number(v, tree.rows()));
}

namespace {

/// Samples of 64 that a buried cell counts for: more than none, so that no frame divides by zero.
constexpr double buried_share = 1.0 / 16;

}  // namespace

void Element::set_space(const CellTree& tree, std::vector<OpenMask> masks) {
    open = std::move(masks);
    std::vector<double> share;
    for (const OpenMask mask : open) {
        // A cell that is buried altogether is measured by next to nothing: its coarser cells are
        // then means over what is open, and what is spread to it is no loss.
        const auto count = static_cast<double>(std::bitset<64>(mask).count());
        share.push_back(std::max(count, buried_share) / 64);
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

bool has_angles(const RadianceSpace& space) {
    return std::any_of(space.elements().begin(), space.elements().end(),
                       [](const Element& element) { return element.angle.levels() > 0; });
}

}  // namespace lightwell
