#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <numeric>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace lightwell {

/// Calls act(k) for every k below `count`, in parallel and those of the largest size(k) first: of a
/// few pieces of very different size, a large one that came last would be waited for.
template <class Size, class Act>
void for_each_largest_first(std::size_t count, const Size& size, const Act& act) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&size](std::size_t a, std::size_t b) { return size(a) > size(b); });
    std::atomic<std::size_t> next{0};
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count),
        [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t k = range.begin(); k != range.end(); ++k)
                act(order[next++]);
        },
        tbb::simple_partitioner());
}

}  // namespace lightwell
