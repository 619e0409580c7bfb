#include "viewer/window/memory_in_use.h"

#if defined(__SANITIZE_ADDRESS__)
// Declared here because not every compiler's package brings <sanitizer/allocator_interface.h>.
extern "C" std::size_t __sanitizer_get_current_allocated_bytes();
#elif defined(__linux__)
#include <malloc.h>
#endif

namespace lightwell {

std::size_t bytes_in_use() {
#if defined(__SANITIZE_ADDRESS__)
    return __sanitizer_get_current_allocated_bytes();
#elif defined(__GLIBC__)
    const struct mallinfo2 told = mallinfo2();
    return told.uordblks + told.hblkhd;
#else
    return 0;
#endif
}

}  // namespace lightwell
