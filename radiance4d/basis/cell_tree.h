#pragma once

#include <cstdint>
#include <vector>

namespace lightwell {

/// How the cells of one level are cut into those of the next.
enum class Split : std::uint8_t { u, v, both };

/// A rectangle of parameters.
struct ParameterRect {
    double u0, u1, v0, v1;
};

/// A cell of a 2D domain: its level (0 is the whole domain) and its number within the level.
struct Cell {
    int level = 0;
    std::uint32_t index = 0;

    bool operator==(const Cell& other) const {
        return level == other.level && index == other.index;
    }
};

/// The hierarchy of cells over one 2D domain [0,1]^2, refined alike everywhere down to its finest
/// level.
///
/// A level cuts its cells in four (the non-standard Haar construction: one square support, a
/// scaling function and three wavelets) or, at the coarse levels of an elongated quad, in two along
/// the long side, so that cells come out near square. Children are numbered along the path from the
/// root: the children of cell m are m * n + c, c = 0 .. n-1, where c counts u first, then v.
///
/// Basis functions over the tree, as many as there are finest cells, are numbered coarse to fine: 0
/// is the scaling function of the whole domain; the wavelets k = 1 .. n-1 of cell (l,m) are
/// cells(l) + (n-1) m + k - 1.
class CellTree {
  public:
    /// The domain itself and nothing finer: one cell, one function.
    CellTree();
    explicit CellTree(std::vector<Split> splits);

    /// Levels of splitting; cells live on levels 0 .. levels().
    int levels() const { return static_cast<int>(splits_.size()); }
    const std::vector<Split>& splits() const { return splits_; }
    /// Number of cells on a level.
    std::uint32_t cells(int level) const { return cells_[static_cast<std::size_t>(level)]; }
    /// Number of basis functions, which is that of finest cells.
    std::uint32_t functions() const { return cells(levels()); }
    /// Number of children of each cell of a level: 2 or 4.
    std::uint32_t children(int level) const {
        return splits_[static_cast<std::size_t>(level)] == Split::both ? 4 : 2;
    }
    Cell child(const Cell& cell, std::uint32_t c) const {
        return {cell.level + 1, cell.index * children(cell.level) + c};
    }
    Cell parent(const Cell& cell) const {
        return {cell.level - 1, cell.index / children(cell.level - 1)};
    }
    bool is_finest(const Cell& cell) const { return cell.level == levels(); }
    /// Number of a cell among the cells of all levels, coarse to fine.
    std::uint32_t position(const Cell& cell) const {
        return first_position_[static_cast<std::size_t>(cell.level)] + cell.index;
    }
    /// The cell at a position.
    Cell at(std::uint32_t position) const;
    /// Number of cells on all levels together.
    std::uint32_t positions() const { return first_position_.back(); }
    /// Number of the basis function: wavelet k = 1 .. children-1 of a cell that is not finest.
    std::uint32_t wavelet(const Cell& cell, std::uint32_t k) const {
        return cells(cell.level) + (children(cell.level) - 1) * cell.index + k - 1;
    }
    /// Level of the cell that a basis function is supported on (0 for the scaling function too).
    int level_of_function(std::uint32_t function) const;
    /// The support of a basis function.
    Cell support(std::uint32_t function) const;
    /// Where a cell lies.
    ParameterRect rect(const Cell& cell) const;
    /// Number of finest cells along u and along v.
    std::uint32_t columns() const { return columns_; }
    std::uint32_t rows() const { return rows_; }
    /// Finest cell in column i (along u) and row j (along v).
    std::uint32_t finest_at(std::uint32_t column, std::uint32_t row) const;
    /// The finest cell around a point; the nearest one for points outside of the domain.
    std::uint32_t finest_around(double u, double v) const;

    bool operator==(const CellTree& other) const { return splits_ == other.splits_; }

  private:
    std::vector<Split> splits_;
    std::vector<std::uint32_t> cells_;
    std::vector<std::uint32_t>
        first_position_;  // one more than levels: the last is the number of positions
    std::uint32_t columns_ = 1;
    std::uint32_t rows_ = 1;
};

/// The tree whose finest cells are nearly square and measure at most `cell` along either side of a
/// domain of the given extents: a long side is halved alone until the two are within a factor of
/// sqrt(2), then both are halved together. At most `most_levels` levels.
CellTree tree_for_extents(double extent_u, double extent_v, double cell, int most_levels);

}  // namespace lightwell
