#include "solver/transport/sparse_analysis.h"

namespace lightwell {

SparseAnalysis::SparseAnalysis(const HaarBasis& basis)
    : basis_(basis),
      scaling_(basis.tree().positions(), 0.0),
      is_touched_(basis.tree().positions(), 0),
      touched_(static_cast<std::size_t>(basis.tree().levels()) + 1) {}

void SparseAnalysis::add(const Cell& cell, double value) {
    const std::uint32_t position = basis_.tree().position(cell);
    scaling_[position] += value;
    if (is_touched_[position] != 0) return;
    is_touched_[position] = 1;
    touched_[static_cast<std::size_t>(cell.level)].push_back(cell.index);
}

void SparseAnalysis::hand_up(const Cell& cell) {
    const CellTree& tree = basis_.tree();
    const Eigen::Matrix4d& weights = basis_.frame(cell);
    Eigen::Vector4d parts = Eigen::Vector4d::Zero();
    for (std::uint32_t c = 0; c < tree.children(cell.level); ++c)
        parts += scaling_[tree.position(tree.child(cell, c))] * weights.col(c);
    scaling_[tree.position(cell)] += parts[0];
    for (std::uint32_t k = 1; k < tree.children(cell.level); ++k)
        if (parts[k] != 0) result_.push_back({tree.wavelet(cell, k), parts[k]});
}

void SparseAnalysis::release(const Cell& cell) {
    const std::uint32_t position = basis_.tree().position(cell);
    scaling_[position] = 0;
    is_touched_[position] = 0;
}

const std::vector<SparseValue>& SparseAnalysis::operator()(const std::vector<SparseValue>& cells) {
    const CellTree& tree = basis_.tree();
    result_.clear();
    for (const SparseValue& given : cells)
        add(tree.at(given.index), given.value);

    for (int level = tree.levels() - 1; level >= 0; --level) {
        std::vector<std::uint32_t>& finer = touched_[static_cast<std::size_t>(level) + 1];
        for (const std::uint32_t index : finer)
            add(tree.parent({level + 1, index}), 0);
        for (const std::uint32_t index : touched_[static_cast<std::size_t>(level)])
            hand_up({level, index});
        for (const std::uint32_t index : finer)
            release({level + 1, index});
        finer.clear();
    }
    if (!cells.empty()) {
        result_.push_back({0, scaling_[0]});
        release({0, 0});
        touched_[0].clear();
    }
    return result_;
}

}  // namespace lightwell
