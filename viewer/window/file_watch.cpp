#include "viewer/window/file_watch.h"

#include <utility>

namespace lightwell {

FileWatch::FileWatch(std::string path) : path_(std::move(path)), last_(mark()) {}

bool FileWatch::has_changed() {
    const std::optional<Mark> now = mark();
    if (!now || (last_ && !(*now != *last_))) return false;
    last_ = now;
    return true;
}

std::optional<FileWatch::Mark> FileWatch::mark() const {
    std::error_code no_time, no_size;
    const auto written = std::filesystem::last_write_time(path_, no_time);
    const auto bytes = std::filesystem::file_size(path_, no_size);
    if (no_time || no_size) return std::nullopt;
    return Mark{written, bytes};
}

}  // namespace lightwell
