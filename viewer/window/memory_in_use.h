#pragma once

#include <cstddef>

namespace lightwell {

/// Bytes that the program has asked its allocator for and has not freed: what is really in use,
/// without what the allocator keeps for later, its own records and the gaps between blocks. 0 where
/// no allocator tells (neither glibc nor the address sanitizer's).
std::size_t bytes_in_use();

}  // namespace lightwell
