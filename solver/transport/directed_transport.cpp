#include "solver/transport/directed_transport.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "radiance4d/basis/angular_reflection.h"
#include "solver/transport/sparse_analysis.h"

namespace lightwell {

namespace {

/// Coefficients smaller than this share of the largest of their pair are rounding.
constexpr double rounding_share = 1e-14;

/// The sub-domains of a link, as axes of its key: cells before they are transformed, functions
/// after.
constexpr std::size_t axes = 4;
enum Axis : std::size_t {
    receiver_space_axis,
    receiver_angle_axis,
    sender_space_axis,
    sender_angle_axis
};

struct Entry {
    std::array<std::uint32_t, axes> key;
    double value;
};

/// Transforms along one axis: entries that agree in all other keys are one function over it.
void transform(const HaarBasis& basis, Axis axis, std::vector<Entry>& entries) {
    const auto others = [axis](const Entry& entry) {
        std::array<std::uint32_t, axes> key = entry.key;
        key[axis] = 0;
        return key;
    };
    std::stable_sort(entries.begin(), entries.end(),
                     [&](const Entry& a, const Entry& b) { return others(a) < others(b); });
    SparseAnalysis analyse(basis);
    std::vector<Entry> result;
    std::vector<SparseValue> cells;
    for (std::size_t first = 0; first < entries.size();) {
        const std::array<std::uint32_t, axes> key = others(entries[first]);
        cells.clear();
        for (; first < entries.size() && others(entries[first]) == key; ++first)
            cells.push_back({entries[first].key[axis], entries[first].value});
        for (const SparseValue& coefficient : analyse(cells)) {
            Entry made{key, coefficient.value};
            made.key[axis] = coefficient.index;
            result.push_back(made);
        }
    }
    entries = std::move(result);
}

/// The block of P between two elements.
std::vector<Coefficient> pair_block(const RadianceSpace& space, const DirectedPair& pair) {
    const Element& x = space.element(pair.receiver);
    const Element& y = space.element(pair.sender);
    const HaarBasis angle_x = angular_basis(x.angle.levels());
    const HaarBasis angle_y = angular_basis(y.angle.levels());
    std::vector<Entry> entries;
    entries.reserve(pair.links.size());
    for (const DirectedLink& link : pair.links) {
        const double measure = x.space.area_at(link.receiver) *
                               angle_x.area_at(link.receiver_angle) * y.space.area_at(link.sender) *
                               angle_y.area_at(link.sender_angle);
        entries.push_back({{link.receiver, link.receiver_angle, link.sender, link.sender_angle},
                           link.exchange / std::sqrt(measure)});
    }
    // The angular axes first: few cells share all the other keys, so that they stay sparse longest.
    if (x.angle.levels() > 0) transform(angle_x, receiver_angle_axis, entries);
    if (y.angle.levels() > 0) transform(angle_y, sender_angle_axis, entries);
    transform(x.space, receiver_space_axis, entries);
    transform(y.space, sender_space_axis, entries);

    double largest = 0;
    for (const Entry& entry : entries)
        largest = std::max(largest, std::abs(entry.value));
    std::vector<Coefficient> result;
    for (const Entry& entry : entries) {
        if (std::abs(entry.value) <= rounding_share * largest) continue;
        const auto& key = entry.key;
        result.push_back(
            {x.first + key[receiver_space_axis] * x.angle.functions() + key[receiver_angle_axis],
             y.first + key[sender_space_axis] * y.angle.functions() + key[sender_angle_axis],
             static_cast<float>(entry.value)});
    }
    return result;
}

}  // namespace

std::vector<Coefficient> directed_transport(const RadianceSpace& space,
                                            const std::vector<DirectedPair>& pairs,
                                            const Progress& progress) {
    std::vector<std::vector<Coefficient>> blocks(pairs.size());
    tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t p) {
        progress.check();
        blocks[p] = pair_block(space, pairs[p]);
    });
    std::vector<Coefficient> all;
    for (std::vector<Coefficient>& block : blocks) {
        all.insert(all.end(), block.begin(), block.end());
        std::vector<Coefficient>().swap(block);
    }
    tbb::parallel_sort(all.begin(), all.end(), [](const Coefficient& a, const Coefficient& b) {
        return a.column != b.column ? a.column < b.column : a.row < b.row;
    });
    return all;
}

}  // namespace lightwell
