#pragma once

#include <cstdint>

namespace lightwell::testing {

/// Whether allocations are counted here: not where a sanitizer has put its own allocator in place.
bool can_count_allocations();

/// Blocks of memory that all threads of this process have asked for since it began.
std::uint64_t allocations();

}  // namespace lightwell::testing
