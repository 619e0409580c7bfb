#include "solver/transport/coefficients.h"

#include <algorithm>
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace lightwell {

std::vector<Coefficient> joined(std::vector<std::vector<Coefficient>> blocks,
                                std::uint32_t columns) {
    std::vector<std::size_t> start(std::size_t{columns} + 1, 0);
    for (const std::vector<Coefficient>& block : blocks)
        for (const Coefficient& c : block)
            ++start[std::size_t{c.column} + 1];
    for (std::size_t column = 0; column < columns; ++column)
        start[column + 1] += start[column];

    std::vector<Coefficient> all(start.back());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for (std::vector<Coefficient>& block : blocks) {
        for (const Coefficient& c : block)
            all[next[c.column]++] = c;
        std::vector<Coefficient>().swap(block);
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, columns, 256), [&](const auto& range) {
        for (std::size_t column = range.begin(); column != range.end(); ++column)
            std::sort(all.begin() + static_cast<std::ptrdiff_t>(start[column]),
                      all.begin() + static_cast<std::ptrdiff_t>(start[column + 1]),
                      [](const Coefficient& a, const Coefficient& b) { return a.row < b.row; });
    });
    return all;
}

}  // namespace lightwell
