#include "solver/transport/largest_first.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace lightwell {

void for_each_largest_first(std::size_t count, const std::function<std::size_t(std::size_t)>& size,
                            const std::function<void(std::size_t)>& act) {
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
