#include "tests/unit/frame/allocations.h"

#include <atomic>
#include <cstddef>

namespace {

std::atomic<std::uint64_t> count{0};

}  // namespace

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)

// The C library's own functions, under the names that it keeps for this.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) {
    ++count;
    return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
    ++count;
    return __libc_calloc(number, size);
}
void* realloc(void* block, std::size_t size) {
    ++count;
    return __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    ++count;
    return __libc_memalign(alignment, size);
}
}

namespace lightwell::testing {

bool can_count_allocations() {
    return true;
}

#else

namespace lightwell::testing {

bool can_count_allocations() {
    return false;
}

#endif

std::uint64_t allocations() {
    return count;
}

}  // namespace lightwell::testing
