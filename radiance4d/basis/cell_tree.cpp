#include "radiance4d/basis/cell_tree.h"

#include <algorithm>
#include <utility>

#include "radiance4d/failure.h"

namespace lightwell {

CellTree::CellTree() : CellTree(std::vector<Split>{}) {}

CellTree::CellTree(std::vector<Split> splits) : splits_(std::move(splits)) {
    cells_.push_back(1);
    first_position_ = {0, 1};
    for (const Split split : splits_) {
        if (split != Split::v) columns_ *= 2;
        if (split != Split::u) rows_ *= 2;
        const std::uint64_t next = std::uint64_t{cells_.back()} * (split == Split::both ? 4 : 2);
        LIGHTWELL_CHECK_OP(next, <=, std::uint64_t{1} << 28);
        cells_.push_back(static_cast<std::uint32_t>(next));
        first_position_.push_back(first_position_.back() + cells_.back());
    }
}

Cell CellTree::at(std::uint32_t position) const {
    int level = 0;
    while (first_position_[static_cast<std::size_t>(level) + 1] <= position)
        ++level;
    return {level, position - first_position_[static_cast<std::size_t>(level)]};
}

int CellTree::level_of_function(std::uint32_t function) const {
    int level = 0;
    while (level + 1 <= levels() && cells(level + 1) <= function)
        ++level;
    return function == 0 ? 0 : level;
}

Cell CellTree::support(std::uint32_t function) const {
    if (function == 0) return {0, 0};
    const int level = level_of_function(function);
    return {level, (function - cells(level)) / (children(level) - 1)};
}

ParameterRect CellTree::rect(const Cell& cell) const {
    // Read the path from the finest digit to the coarsest, growing the rectangle on the way.
    ParameterRect rect{0, 1, 0, 1};
    std::uint32_t rest = cell.index;
    for (int level = cell.level - 1; level >= 0; --level) {
        const Split split = splits_[static_cast<std::size_t>(level)];
        const std::uint32_t digit = rest % children(level);
        rest /= children(level);
        const std::uint32_t in_u = split == Split::v ? 0 : digit & 1U;
        const std::uint32_t in_v = split == Split::v ? digit : digit >> 1U;
        if (split != Split::v) {
            rect.u0 = 0.5 * (rect.u0 + in_u);
            rect.u1 = 0.5 * (rect.u1 + in_u);
        }
        if (split != Split::u) {
            rect.v0 = 0.5 * (rect.v0 + in_v);
            rect.v1 = 0.5 * (rect.v1 + in_v);
        }
    }
    return rect;
}

std::uint32_t CellTree::finest_at(std::uint32_t column, std::uint32_t row) const {
    std::uint32_t index = 0, columns = columns_, rows = rows_;
    // Whether a number is in the upper half of so many, and where in it.
    const auto is_upper = [](std::uint32_t& number, std::uint32_t& of) {
        of /= 2;
        if (number < of) return 0U;
        number -= of;
        return 1U;
    };
    for (const Split split : splits_) {
        std::uint32_t digit = 0;
        if (split != Split::v) digit += is_upper(column, columns);
        if (split != Split::u) digit += is_upper(row, rows) * (split == Split::both ? 2 : 1);
        index = index * (split == Split::both ? 4 : 2) + digit;
    }
    return index;
}

std::uint32_t CellTree::finest_around(double u, double v) const {
    const auto number = [](double at, std::uint32_t cells) {
        return std::min(static_cast<std::uint32_t>(std::max(0.0, at) * cells), cells - 1);
    };
    return finest_at(number(u, columns_), number(v, rows_));
}

CellTree tree_for_extents(double extent_u, double extent_v, double cell, int most_levels) {
    constexpr double near_square = 1.4142135623730951;
    std::vector<Split> splits;
    while (static_cast<int>(splits.size()) < most_levels && (extent_u > cell || extent_v > cell)) {
        const bool along_u = extent_v <= near_square * extent_u;
        const bool along_v = extent_u <= near_square * extent_v;
        splits.push_back(along_u && along_v ? Split::both : along_u ? Split::u : Split::v);
        if (along_u) extent_u /= 2;
        if (along_v) extent_v /= 2;
    }
    return CellTree(std::move(splits));
}

}  // namespace lightwell
