#include "radiance4d/atomic_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& act, int code) {
    throw SystemError(
        fmt::format("{}: cannot {}: {}", path, act, std::generic_category().message(code)));
}

/// A file that is gone again unless it is renamed. Where the system can, it has no name until then,
/// so that not even a killed program leaves a part of it behind.
class Temporary {
  public:
    /// Made with the permissions that the user's umask allows any new file.
    explicit Temporary(const std::string& target) : target_(target) {
        const std::filesystem::path folder = std::filesystem::path(target).parent_path();
        if (access(open_files, X_OK) == 0)
            descriptor_ =
                open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
        has_name_ = descriptor_ < 0;
        if (has_name_) descriptor_ = named();
    }
    ~Temporary() {
        if (descriptor_ >= 0) close(descriptor_);
        if (has_name_) unlink(name_.c_str());
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    void write(std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written <= 0) fail(target_, "write", written < 0 ? errno : ENOSPC);
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
        if (fsync(descriptor_) != 0) fail(target_, "write", errno);
        if (!has_name_) return;
        // Network file systems tell of a lost write when the file is closed.
        const int code = close(descriptor_) == 0 ? 0 : errno;
        descriptor_ = code == 0 ? open(name_.c_str(), O_RDONLY | O_CLOEXEC) : -1;
        if (descriptor_ < 0) fail(target_, "write", code == 0 ? errno : code);
    }

    /// Some file systems report a lost write to nobody, so the file itself is asked.
    void compare(std::string_view bytes) {
        if (lseek(descriptor_, 0, SEEK_SET) != 0) fail(target_, "read back", errno);
        std::vector<char> block(std::size_t{1} << 16);
        for (;;) {
            const ssize_t count = read(descriptor_, block.data(), block.size());
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) fail(target_, "read back", errno);
            const auto size = static_cast<std::size_t>(count);
            if (bytes.substr(0, size) != std::string_view(block.data(), size))
                fail(target_, "read back what was written", EIO);
            if (size == 0) break;
            bytes.remove_prefix(size);
        }
        if (!bytes.empty()) fail(target_, "read back what was written", EIO);
    }

    void rename_to_target() {
        if (!has_name_) give_name();
        if (std::rename(name_.c_str(), target_.c_str()) != 0) fail(target_, "write", errno);
        has_name_ = false;
    }

  private:
    /// Where the system lists the open files of a process.
    static constexpr const char* open_files = "/proc/self/fd";

    /// Short, because the target's name may be as long as names can be.
    std::string next_name() {
        const std::filesystem::path folder = std::filesystem::path(target_).parent_path();
        return (folder / fmt::format("lightwell-{}-{}.part", getpid(), attempt_++)).string();
    }

    int named() {
        for (;;) {
            name_ = next_name();
            const int descriptor = open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
            if (descriptor >= 0) return descriptor;
            if (errno == EEXIST) continue;
            has_name_ = false;
            if (errno == ENOENT || errno == ENOTDIR)
                throw InputError(target_ + ": the folder does not exist");
            fail(target_, "write", errno);
        }
    }

    void give_name() {
        const std::string here = fmt::format("{}/{}", open_files, descriptor_);
        do {
            name_ = next_name();
            has_name_ =
                linkat(AT_FDCWD, here.c_str(), AT_FDCWD, name_.c_str(), AT_SYMLINK_FOLLOW) == 0;
        } while (!has_name_ && errno == EEXIST);
        if (!has_name_) fail(target_, "write", errno);
    }

    std::string target_;
    std::string name_;
    int descriptor_ = -1;
    int attempt_ = 0;
    bool has_name_ = false;
};

/// Forces the new name to the disk. Not every file system can; the file itself is safe already.
void synchronise(const std::filesystem::path& folder) {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    fsync(descriptor);
    close(descriptor);
}

/// Where a file of that name is to be put, symbolic links followed.
std::filesystem::path target_of(const std::string& path) {
    namespace fs = std::filesystem;
    if (path.empty()) throw InputError("the file to write has no name");
    std::error_code error;
    fs::path target(path);
    if (fs::is_symlink(target, error)) target = fs::weakly_canonical(target, error);
    if (error == std::errc::filename_too_long)
        throw InputError(fmt::format("{}: {}", path, error.message()));
    if (!target.has_filename() ||
        (fs::exists(target, error) && !fs::is_regular_file(target, error)))
        throw InputError(fmt::format("{}: is not a regular file", path));
    return target;
}

}  // namespace

void write_atomically(const std::string& path, std::string_view bytes) {
    const std::filesystem::path target = target_of(path);
    Temporary temporary(target.string());
    temporary.write(bytes);
    temporary.compare(bytes);
    temporary.rename_to_target();
    synchronise(target.has_parent_path() ? target.parent_path() : std::filesystem::path("."));
}

void require_writable(const std::string& path) {
    // Only trying tells: permissions, read-only disks and root's rights all have their own rules.
    const Temporary temporary(target_of(path).string());
}

}  // namespace lightwell
