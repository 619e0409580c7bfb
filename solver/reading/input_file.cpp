#include "solver/reading/input_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

/// A file descriptor that closes itself.
class Descriptor {
  public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number() const { return number_; }

  private:
    int number_;
};

std::string message_of(int error) {
    return std::strerror(error);
}

}  // namespace

std::string read_bytes(const std::string& path, std::int64_t limit) {
    const Place place{path};
    // Without O_NONBLOCK, opening a pipe waits for its writer, perhaps for ever.
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (file.number() < 0) throw InputError(place, "cannot be opened: " + message_of(errno));
    struct stat status {};
    if (::fstat(file.number(), &status) != 0)
        throw SystemError(path + ": its size cannot be found: " + message_of(errno));
    if (S_ISDIR(status.st_mode)) throw InputError(place, "is a folder, not a file");
    if (!S_ISREG(status.st_mode)) throw InputError(place, "is a device or pipe, not a file");
    if (status.st_size > limit)
        throw InputError(place,
                         fmt::format("has {} bytes; at most {} are read", status.st_size, limit));
    std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t step = ::read(file.number(), bytes.data() + done, bytes.size() - done);
        if (step < 0 && errno == EINTR) continue;
        if (step < 0) throw SystemError(path + ": cannot be read: " + message_of(errno));
        if (step == 0) break;
        done += static_cast<std::size_t>(step);
    }
    bytes.resize(done);
    return bytes;
}

std::string read_text(const std::string& path, std::int64_t limit) {
    std::string text = read_bytes(path, limit);
    const std::string_view start = std::string_view(text).substr(0, 4);
    const bool other_mark = start.substr(0, 2) == "\xff\xfe" || start.substr(0, 2) == "\xfe\xff";
    if (other_mark || start.find('\0') != std::string_view::npos)
        throw InputError(Place{path, 1, 1},
                         "is not UTF-8 text (it looks like UTF-16 or like a "
                         "binary file); save it as UTF-8");
    if (start.substr(0, 3) == "\xef\xbb\xbf") text.erase(0, 3);
    return text;
}

std::string in_quotes(const std::string& text) {
    constexpr std::size_t longest = 40;
    std::string shown = "'";
    for (const char letter : text.substr(0, longest)) {
        const auto byte = static_cast<unsigned char>(letter);
        if (byte < 0x20 || byte == 0x7f)
            shown += fmt::format("\\x{:02x}", byte);
        else
            shown += letter;
    }
    return shown + (text.size() > longest ? "...'" : "'");
}

}  // namespace lightwell
