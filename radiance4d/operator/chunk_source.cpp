#include "radiance4d/operator/chunk_source.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>
#include <zstd.h>

#include "radiance4d/failure.h"
#include "radiance4d/operator/byte_stream.h"

namespace lightwell {

namespace {

/// Read at once: small enough to be still in the cache when its checksum is taken.
constexpr std::size_t piece = std::size_t{1} << 18;

std::string message_of(int code) {
    return std::generic_category().message(code);
}

/// A checksum that is taken piece by piece.
class RunningChecksum {
  public:
    RunningChecksum() : state_(XXH3_createState(), XXH3_freeState) {
        if (!state_) throw std::bad_alloc();
        XXH3_64bits_reset(state_.get());
    }
    void add(const char* bytes, std::size_t size) { XXH3_64bits_update(state_.get(), bytes, size); }
    std::uint64_t value() const { return XXH3_64bits_digest(state_.get()); }

  private:
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

/// What a file that does not start with the magic is, as far as one can tell.
std::string foreign(std::string_view start) {
    if (start.empty()) return "is empty";
    if (start.substr(0, 8) == file_magic.substr(0, start.size()))
        return "is an operator file that is cut short";
    if (start.size() >= 4 && start.substr(1, 3) == "GTO")
        return "is an operator file that was damaged in transfer";
    return "is not an operator file of Lightwell";
}

bool is_tag(std::string_view tag) {
    return std::all_of(tag.begin(), tag.end(), [](char letter) {
        return (letter >= 'A' && letter <= 'Z') || (letter >= 'a' && letter <= 'z');
    });
}

}  // namespace

ChunkSource::ChunkSource(const std::string& path) : path_(path) {
    try {
        open();
        read_head();
    } catch (...) {
        if (descriptor_ >= 0) close(descriptor_);
        throw;
    }
}

ChunkSource::~ChunkSource() {
    close(descriptor_);
}

void ChunkSource::open() {
    // Without O_NONBLOCK, a pipe that nobody writes to would be waited for.
    descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0) refuse("cannot be opened: " + message_of(errno));
    struct stat status;
    if (fstat(descriptor_, &status) != 0)
        throw SystemError(fmt::format("{}: {}", path_, message_of(errno)));
    if (!S_ISREG(status.st_mode)) refuse("is not a regular file");
    bytes_ = static_cast<std::uint64_t>(status.st_size);
}

void ChunkSource::read_head() {
    char fixed[table_offset];
    const auto start = static_cast<std::size_t>(std::min<std::uint64_t>(bytes_, table_offset));
    read(0, fixed, start);
    if (start < table_offset || std::string_view(fixed, 8) != file_magic)
        refuse(foreign({fixed, start}));

    ByteReader reader(std::string_view(fixed, table_offset).substr(8), path_);
    version_ = reader.number<std::uint32_t>();
    const auto count = reader.number<std::uint32_t>();
    const auto announced = reader.number<std::uint64_t>();
    scene_hash_ = reader.number<std::uint64_t>();
    if (version_ > file_version)
        refuse(fmt::format("has format version {}, this program reads up to {}: use a newer one",
                           version_, file_version));
    if (announced > bytes_)
        refuse(fmt::format("is cut short: {} bytes of {} are there", bytes_, announced));
    if (announced < bytes_) refuse(fmt::format("has {} bytes after its end", bytes_ - announced));
    if (version_ == 0 || count > most_chunks || head_bytes(count) > bytes_)
        refuse("damaged operator file: the head (bytes 0 to 32) makes no sense");

    std::string head(head_bytes(count), '\0');
    read(0, head.data(), head.size());
    const std::string_view body = std::string_view(head).substr(0, head.size() - 8);
    ByteReader sum(std::string_view(head).substr(body.size()), path_);
    if (sum.number<std::uint64_t>() != checksum_of(body))
        refuse(
            fmt::format("damaged operator file: the head (bytes 0 to {}) does not match its "
                        "checksum",
                        head.size()));
    read_table(body.substr(table_offset));
}

void ChunkSource::read_table(std::string_view table) {
    ByteReader reader(table, path_ + ": damaged operator file: chunk table");
    std::uint64_t next = table_offset + table.size() + 8;
    while (reader.left() > 0) {
        ChunkSummary entry;
        entry.tag = std::string(reader.take(4));
        const auto encoding = reader.number<std::uint32_t>();
        entry.compressed = encoding == 1;
        entry.offset = next;
        entry.stored = reader.number<std::uint64_t>();
        entry.content = reader.number<std::uint64_t>();
        entry.checksum = reader.number<std::uint64_t>();
        if (!is_tag(entry.tag)) reader.fail("a tag is not four letters");
        if (encoding > 1) reader.fail(fmt::format("encoding {} is unknown", encoding));
        if (entry.stored > bytes_ - next)
            reader.fail(fmt::format("chunk {} reaches beyond the file", entry.tag));
        if (entry.compressed ? entry.content > most_growth * entry.stored
                             : entry.content != entry.stored)
            reader.fail(fmt::format("chunk {} claims to grow from {} to {} bytes", entry.tag,
                                    entry.stored, entry.content));
        next += entry.stored;
        chunks_.push_back(entry);
    }
    if (next != bytes_) reader.fail("the chunks do not fill the file");
}

std::size_t ChunkSource::count(std::string_view tag) const {
    return static_cast<std::size_t>(
        std::count_if(chunks_.begin(), chunks_.end(),
                      [&](const ChunkSummary& entry) { return entry.tag == tag; }));
}

const ChunkSummary& ChunkSource::chunk(std::string_view tag, std::size_t nth) const {
    LIGHTWELL_CHECK_OP(nth, <, count(tag));
    auto found = chunks_.begin();
    while (found->tag != tag || nth-- > 0)
        ++found;
    return *found;
}

ChunkContent ChunkSource::stored(const ChunkSummary& chunk) const {
    ChunkContent bytes(chunk.stored);
    if (read(chunk.offset, bytes.begin(), chunk.stored) != chunk.checksum)
        throw InputError(place(chunk) + " does not match its checksum");
    return bytes;
}

ChunkContent ChunkSource::content(const ChunkSummary& chunk) const {
    ChunkContent packed = stored(chunk);
    if (!chunk.compressed) return packed;

    const std::string_view frame = packed.view();
    if (ZSTD_getFrameContentSize(frame.data(), frame.size()) != chunk.content)
        throw InputError(place(chunk) + " does not unpack to the length in the table");
    ChunkContent content(chunk.content);
    const std::size_t size =
        ZSTD_decompress(content.begin(), chunk.content, frame.data(), frame.size());
    if (ZSTD_isError(size))
        throw InputError(
            fmt::format("{} cannot be unpacked: {}", place(chunk), ZSTD_getErrorName(size)));
    if (size != chunk.content)
        throw InputError(place(chunk) + " does not unpack to the length in the table");
    return content;
}

std::string ChunkSource::place(const ChunkSummary& chunk) const {
    return fmt::format("{}: damaged operator file: chunk {} (bytes {} to {})", path_, chunk.tag,
                       chunk.offset, chunk.offset + chunk.stored);
}

std::uint64_t ChunkSource::read(std::uint64_t offset, char* target, std::size_t size) const {
    RunningChecksum checksum;
    while (size > 0) {
        const ssize_t got =
            pread(descriptor_, target, std::min(size, piece), static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw SystemError(fmt::format("{}: {}", path_, message_of(errno)));
        if (got == 0) refuse("became shorter while it was read");
        checksum.add(target, static_cast<std::size_t>(got));
        target += got;
        offset += static_cast<std::uint64_t>(got);
        size -= static_cast<std::size_t>(got);
    }
    return checksum.value();
}

void ChunkSource::refuse(const std::string& why) const {
    throw InputError(fmt::format("{}: {}", path_, why));
}

}  // namespace lightwell
