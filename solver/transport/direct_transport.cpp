#include "solver/transport/direct_transport.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "solver/transport/sparse_analysis.h"

namespace lightwell {

namespace {

/// Coefficients smaller than this share of the largest of their pair are rounding.
constexpr double rounding_share = 1e-14;

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
std::vector<Coefficient> pair_block(const RadianceSpace& space, const PairLinks& pair) {
    const Element& x = space.element(pair.receiver);
    const Element& y = space.element(pair.sender);
    std::vector<HalfTransformed> half = sender_transformed(x, y, pair.links);
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
    return result;
}

}  // namespace

std::vector<Coefficient> direct_transport(const RadianceSpace& space,
                                          const std::vector<PairLinks>& pairs,
                                          const Progress& progress) {
    std::vector<std::vector<Coefficient>> blocks(pairs.size());
    std::atomic<std::size_t> finished{0};
    tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t p) {
        progress.check();
        blocks[p] = pair_block(space, pairs[p]);
        progress.say("operator",
                     static_cast<double>(++finished) / static_cast<double>(pairs.size()));
    });
    std::size_t count = 0;
    for (const auto& block : blocks)
        count += block.size();
    std::vector<Coefficient> all;
    all.reserve(count);
    for (auto& block : blocks) {
        all.insert(all.end(), block.begin(), block.end());
        std::vector<Coefficient>().swap(block);
    }
    tbb::parallel_sort(all.begin(), all.end(), [](const Coefficient& a, const Coefficient& b) {
        return a.column != b.column ? a.column < b.column : a.row < b.row;
    });
    return all;
}

namespace {

/// For every basis function, what the operator makes of uniform light, by way of the columns (or
/// rows, it is symmetric) of whole elements: sum_s m_rs sqrt(A_s).
Eigen::ArrayXd response_to_uniform(const RadianceSpace& space, const std::vector<bool>& is_mean,
                                   const std::vector<Coefficient>& coefficients,
                                   const std::vector<bool>* kept) {
    Eigen::ArrayXd root = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(space.functions()));
    for (const Element& element : space.elements())
        root[element.first] = std::sqrt(element.area());
    Eigen::ArrayXd response = Eigen::ArrayXd::Zero(root.size());
    for (std::size_t k = 0; k < coefficients.size(); ++k) {
        if (kept != nullptr && !(*kept)[k]) continue;
        const Coefficient& c = coefficients[k];
        if (is_mean[c.column]) response[c.row] += static_cast<double>(c.value) * root[c.column];
        if (is_mean[c.row]) response[c.column] += static_cast<double>(c.value) * root[c.row];
    }
    return response;
}

}  // namespace

SymmetricOperator truncated(const RadianceSpace& space, const std::vector<bool>& closed,
                            const std::vector<Coefficient>& coefficients,
                            const Eigen::ArrayXd& weight, double threshold) {
    std::vector<bool> is_mean(space.functions(), false);
    for (const Element& element : space.elements())
        is_mean[element.first] = true;
    std::vector<bool> kept(coefficients.size());
    for (std::size_t k = 0; k < coefficients.size(); ++k) {
        const Coefficient& c = coefficients[k];
        kept[k] =
            std::abs(static_cast<double>(c.value)) * std::max(weight[c.row], weight[c.column]) >=
                threshold ||
            (is_mean[c.row] && is_mean[c.column]);
    }

    // What uniform light becomes: where nothing escapes, uniform light again; elsewhere, what it
    // was before truncation. A ripple that coarse links and truncation leave in it is fed back by
    // every bounce and costs energy in its square, which high albedo amplifies. What a row lacks is
    // given to the coefficients that it kept, by their squares, so that large ones bear most and
    // change least.
    Eigen::ArrayXd wanted = response_to_uniform(space, is_mean, coefficients, nullptr);
    for (std::size_t e = 0; e < space.elements().size(); ++e) {
        const Element& element = space.element(e);
        if (closed[e]) wanted.segment(element.first + 1, element.functions() - 1) = 0;
    }
    const Eigen::ArrayXd lost = wanted - response_to_uniform(space, is_mean, coefficients, &kept);
    Eigen::ArrayXd carried = Eigen::ArrayXd::Zero(lost.size());
    const auto root = [&](std::uint32_t function) {
        return std::sqrt(space.element(space.element_of(function)).area());
    };
    for (std::size_t k = 0; k < coefficients.size(); ++k) {
        const Coefficient& c = coefficients[k];
        if (!kept[k] || is_mean[c.row] == is_mean[c.column]) continue;
        const std::uint32_t detail = is_mean[c.column] ? c.row : c.column;
        carried[detail] += static_cast<double>(c.value) * static_cast<double>(c.value) *
                           root(is_mean[c.column] ? c.column : c.row);
    }

    SymmetricOperator result;
    TransportOperator& upper = result.upper;
    upper.size = space.functions();
    upper.column_start.assign(1, 0);
    std::size_t next = 0;
    for (std::uint32_t column = 0; column < upper.size; ++column) {
        for (; next < coefficients.size() && coefficients[next].column == column; ++next) {
            if (!kept[next]) continue;
            const Coefficient& c = coefficients[next];
            double value = static_cast<double>(c.value);
            if (is_mean[c.row] != is_mean[c.column]) {
                const std::uint32_t detail = is_mean[c.column] ? c.row : c.column;
                if (carried[detail] > 0) value += lost[detail] * value * value / carried[detail];
            }
            upper.row.push_back(c.row);
            upper.value.push_back(static_cast<float>(value));
        }
        upper.column_start.push_back(upper.value.size());
    }
    return result;
}

}  // namespace lightwell
