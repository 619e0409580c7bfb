#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/basis/haar.h"

namespace lightwell {

/// A number and the cell (CellTree::position) or the basis function that it belongs to.
struct SparseValue {
    std::uint32_t index = 0;
    double value = 0;
};

/// The Haar analysis of functions that live on few of a large domain's cells, at a cost
/// proportional to those cells and their ancestors. Gives what HaarBasis::analyse gives.
///
/// Keeps its working memory between calls: one object per thread.
class SparseAnalysis {
  public:
    /// The basis must outlive the object.
    explicit SparseAnalysis(const HaarBasis& basis);

    /// Coefficients of sum_k value_k phi_k, with phi_k the scaling function (norm 1) of cell
    /// index_k, of whatever level; cells may repeat and overlap. Every function appears at most
    /// once, and always in the same order for the same input; exact zeros are left out.
    const std::vector<SparseValue>& operator()(const std::vector<SparseValue>& cells);

  private:
    /// Adds to the scaling coefficient of a cell.
    void add(const Cell& cell, double value);
    /// Turns the scaling coefficients of a cell's children into the cell's own and its wavelets'.
    void hand_up(const Cell& cell);
    void release(const Cell& cell);

    const HaarBasis& basis_;
    std::vector<double> scaling_;                      // by position; zero between calls
    std::vector<char> is_touched_;                     // by position; zero between calls
    std::vector<std::vector<std::uint32_t>> touched_;  // by level: cells of the level
    std::vector<SparseValue> result_;
};

}  // namespace lightwell
