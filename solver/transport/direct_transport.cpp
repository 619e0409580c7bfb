#include "solver/transport/direct_transport.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

namespace lightwell {

namespace {

/// Coefficients smaller than this share of the largest of their pair are rounding.
constexpr double rounding_share = 1e-14;

/// First and one past the last cell of level `depth` below a cell.
std::pair<std::uint32_t, std::uint32_t> cells_below(const CellTree& tree, const Cell& cell,
                                                    int depth) {
    const std::uint32_t each = tree.cells(depth) / tree.cells(cell.level);
    return {cell.index * each, (cell.index + 1) * each};
}

/// sqrt of the areas of the cells of one level.
Eigen::ArrayXd root_areas(const HaarBasis& basis, int depth) {
    Eigen::ArrayXd roots(basis.tree().cells(depth));
    for (std::uint32_t m = 0; m < basis.tree().cells(depth); ++m)
        roots[m] = std::sqrt(basis.area({depth, m}));
    return roots;
}

/// The block of M between two elements at the depth that its links need, transformed on both sides.
std::vector<Coefficient> pair_block(const RadianceSpace& space, const PairLinks& pair) {
    const Element& x = space.element(pair.receiver);
    const Element& y = space.element(pair.sender);
    const CellTree& tree_x = x.space.tree();
    const CellTree& tree_y = y.space.tree();
    int depth_x = 0, depth_y = 0;
    for (const LinkValue& link : pair.links) {
        depth_x = std::max(depth_x, tree_x.at(link.receiver).level);
        depth_y = std::max(depth_y, tree_y.at(link.sender).level);
    }

    // Half-densities: the coefficient between two cells is exchange / sqrt(A_r A_s), spread over
    // their parts by area.
    const Eigen::ArrayXd root_x = root_areas(x.space, depth_x);
    const Eigen::ArrayXd root_y = root_areas(y.space, depth_y);
    RowMatrix block = RowMatrix::Zero(root_x.size(), root_y.size());
    for (const LinkValue& link : pair.links) {
        const Cell cell_x = tree_x.at(link.receiver), cell_y = tree_y.at(link.sender);
        const auto [x0, x1] = cells_below(tree_x, cell_x, depth_x);
        const auto [y0, y1] = cells_below(tree_y, cell_y, depth_y);
        const double density = link.exchange / (x.space.area(cell_x) * y.space.area(cell_y));
        block.block(x0, y0, x1 - x0, y1 - y0) += density * root_x.segment(x0, x1 - x0).matrix() *
                                                 root_y.segment(y0, y1 - y0).matrix().transpose();
    }
    x.space.analyse(block, depth_x);
    RowMatrix transposed = block.transpose();
    y.space.analyse(transposed, depth_y);

    const double smallest = rounding_share * transposed.cwiseAbs().maxCoeff();
    std::vector<Coefficient> result;
    for (Eigen::Index column = 0; column < transposed.rows(); ++column) {
        for (Eigen::Index row = 0; row < transposed.cols(); ++row) {
            const double value = transposed(column, row);
            if (std::abs(value) > smallest)
                result.push_back({x.first + static_cast<std::uint32_t>(row),
                                  y.first + static_cast<std::uint32_t>(column),
                                  static_cast<float>(value)});
        }
    }
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
    std::sort(all.begin(), all.end(), [](const Coefficient& a, const Coefficient& b) {
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
