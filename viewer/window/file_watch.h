#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace lightwell {

/// Notices when another file has taken a file's name, or its content has been written anew.
class FileWatch {
  public:
    explicit FileWatch(std::string path);

    const std::string& path() const { return path_; }
    /// Whether the file has changed since the last call, or since construction. A file that is
    /// away, as for a moment while it is replaced, has not changed yet.
    bool has_changed();

  private:
    struct Mark {
        std::filesystem::file_time_type written;
        std::uintmax_t bytes;
        bool operator!=(const Mark& other) const {
            return written != other.written || bytes != other.bytes;
        }
    };
    std::optional<Mark> mark() const;

    std::string path_;
    std::optional<Mark> last_;
};

}  // namespace lightwell
