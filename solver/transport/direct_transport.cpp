#include "solver/transport/direct_transport.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "solver/transport/sparse_analysis.h"

namespace lightwell {

namespace {

/// A coefficient half way: receiver still by cell, sender by basis function.
struct HalfTransformed {
    std::uint32_t sender_function = 0;
    SparseValue receiver_cell;
};

/// Transforms the sender's side of each receiver cell's links. With half-densities, the coefficient
/// between two cells is exchange / sqrt(A_r A_s).
std::vector<HalfTransformed> sender_transformed(const Element& x, const Element& y,
                                                std::vector<LinkValue> links) {
    std::stable_sort(links.begin(), links.end(), [](const LinkValue& a, const LinkValue& b) {
        return a.receiver < b.receiver;
    });
    SparseAnalysis analyse(y.space);
    std::vector<HalfTransformed> result;
    std::vector<SparseValue> cells;
    for (std::size_t first = 0; first < links.size();) {
        const std::uint32_t receiver = links[first].receiver;
        cells.clear();
        for (; first < links.size() && links[first].receiver == receiver; ++first)
            cells.push_back(
                {links[first].sender,
                 links[first].exchange /
                     std::sqrt(x.space.area_at(receiver) * y.space.area_at(links[first].sender))});
        for (const SparseValue& coefficient : analyse(cells))
            result.push_back({coefficient.index, {receiver, coefficient.value}});
    }
    return result;
}

/// The block of M between two elements, transformed on both sides.
std::vector<Coefficient> pair_block(const RadianceSpace& space, PairLinks pair) {
    const Element& x = space.element(pair.receiver);
    const Element& y = space.element(pair.sender);
    std::vector<HalfTransformed> half = sender_transformed(x, y, std::move(pair.links));
    std::stable_sort(half.begin(), half.end(),
                     [](const HalfTransformed& a, const HalfTransformed& b) {
                         return a.sender_function < b.sender_function;
                     });
    SparseAnalysis analyse(x.space);
    std::vector<Coefficient> result;
    std::vector<SparseValue> cells;
    double largest = 0;
    for (std::size_t first = 0; first < half.size();) {
        const std::uint32_t sender = half[first].sender_function;
        cells.clear();
        for (; first < half.size() && half[first].sender_function == sender; ++first)
            cells.push_back(half[first].receiver_cell);
        for (const SparseValue& coefficient : analyse(cells)) {
            largest = std::max(largest, std::abs(coefficient.value));
            result.push_back({x.first + coefficient.index, y.first + sender,
                              static_cast<float>(coefficient.value)});
        }
    }
    const double smallest = rounding_share * largest;
    result.erase(std::remove_if(result.begin(), result.end(),
                                [smallest](const Coefficient& c) {
                                    return std::abs(static_cast<double>(c.value)) <= smallest;
                                }),
                 result.end());
    result.shrink_to_fit();  // all blocks are held at once
    return result;
}

}  // namespace

std::vector<Coefficient> direct_transport(const RadianceSpace& space, std::vector<PairLinks> pairs,
                                          const Progress& progress) {
    std::vector<std::vector<Coefficient>> blocks(pairs.size());
    std::atomic<std::size_t> finished{0};
    tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t p) {
        progress.check();
        blocks[p] = pair_block(space, std::move(pairs[p]));
        progress.say("operator",
                     static_cast<double>(++finished) / static_cast<double>(pairs.size()));
    });
    return joined(std::move(blocks), space.functions());
}

}  // namespace lightwell
