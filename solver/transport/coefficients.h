#pragma once

#include <cstdint>
#include <vector>

namespace lightwell {

/// One coefficient of a geometric operator, row < column.
struct Coefficient {
    std::uint32_t row = 0;
    std::uint32_t column = 0;
    float value = 0;
};

/// Coefficients smaller than this share of the largest of their pair of elements are rounding.
constexpr double rounding_share = 1e-14;

/// The coefficients of all blocks, ordered by column, then row. Each place may occur once.
///
/// @param columns  of the operator; every column is below this
std::vector<Coefficient> joined(std::vector<std::vector<Coefficient>> blocks,
                                std::uint32_t columns);

}  // namespace lightwell
