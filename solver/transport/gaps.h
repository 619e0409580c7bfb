#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/basis/radiance_space.h"

namespace lightwell {

/// Two elements that face each other at a small distance: a lamp's housing and the ceiling above
/// it, a shelf and the board below. What light gets in fades within a few heights of the gap from
/// its rim, however wide the elements are.
struct Gap {
    std::uint32_t first = 0, second = 0;  ///< elements
    double height = 0;                    ///< between them, where it is least [m]
    double rim = 0;                       ///< around what faces each other, about [m]
};

/// All gaps up to a height, by first, then second. Whether something stands in them is not asked.
std::vector<Gap> gaps_between(const std::vector<Element>& elements, double highest);

/// How wide cells in gaps may be at most, so that what they blur at the rims stays a small part of
/// an error [m]; infinite without gaps that are lower than the other cells are wide, which need no
/// cells of their own.
///
/// @param cell_size  of the other cells [m]
/// @param area       of all elements [m2]
double gap_cell_size(const std::vector<Gap>& gaps, double cell_size, double area, double error);

/// Refines the cells of elements at gaps that are lower than cells are wide: to twice the height,
/// which shows how the light fades, but no finer than `gap_cell_size`.
///
/// @param elements  whose cells have been set to `cell_size`
void set_gap_cells(const std::vector<Gap>& gaps, double cell_size, double gap_cell_size,
                   int most_levels, std::vector<Element>& elements);

}  // namespace lightwell
