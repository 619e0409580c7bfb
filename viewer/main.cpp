#include <malloc.h>

#include "viewer/commands/command_line.h"

namespace {

/// Memory that was freed is kept for what follows: fields and operators of many megabytes come and
/// go, and to have them cleared by the system each time took a tenth of a glossy precompute
/// (70 -> 62 s in scenes/glossy at 5 %, for a sixth more memory; offices take as much as before).
void keep_freed_memory() {
    constexpr int largest_kept = 256 << 20, most_kept = 1 << 30;  // bytes
    mallopt(M_MMAP_THRESHOLD, largest_kept);
    mallopt(M_TRIM_THRESHOLD, most_kept);
}

}  // namespace

int main(int argc, char** argv) {
    keep_freed_memory();
    return lightwell::run_command_line(argc, argv);
}
