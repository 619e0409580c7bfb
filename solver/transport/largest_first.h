#pragma once

#include <cstddef>
#include <functional>

namespace lightwell {

/// Calls act(k) for every k below `count`, in parallel and those of the largest size(k) first: of a
/// few pieces of very different size, a large one that came last would be waited for.
void for_each_largest_first(std::size_t count, const std::function<std::size_t(std::size_t)>& size,
                            const std::function<void(std::size_t)>& act);

}  // namespace lightwell
