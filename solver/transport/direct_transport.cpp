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

SymmetricOperator truncated(const RadianceSpace& space,
                            const std::vector<Coefficient>& coefficients,
                            const Eigen::ArrayXd& weight, double threshold) {
    std::vector<bool> is_mean(space.functions(), false);
    for (const Element& element : space.elements())
        is_mean[element.first] = true;

    SymmetricOperator result;
    TransportOperator& upper = result.upper;
    upper.size = space.functions();
    upper.column_start.assign(1, 0);
    std::size_t next = 0;
    for (std::uint32_t column = 0; column < upper.size; ++column) {
        for (; next < coefficients.size() && coefficients[next].column == column; ++next) {
            const Coefficient& c = coefficients[next];
            const double magnitude =
                std::abs(static_cast<double>(c.value)) * std::max(weight[c.row], weight[c.column]);
            if (magnitude < threshold && !(is_mean[c.row] && is_mean[c.column])) continue;
            upper.row.push_back(c.row);
            upper.value.push_back(c.value);
        }
        upper.column_start.push_back(upper.value.size());
    }
    return result;
}

}  // namespace lightwell
