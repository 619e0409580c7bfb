#include "radiance4d/operator/file_layout.h"

#include <xxhash.h>
#include <zstd.h>

#include "radiance4d/failure.h"
#include "radiance4d/operator/byte_stream.h"

namespace lightwell {

namespace {

/// Levels above pack operators hardly better and unpack no faster.
constexpr int zstd_level = 1;

bool pays(std::size_t packed, std::size_t content) {
    return packed <= content - content / 16 && content <= most_growth * packed;
}

}  // namespace

std::uint64_t checksum_of(std::string_view bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

FileAssembly::FileAssembly(std::size_t chunks) : bytes_(head_bytes(chunks), '\0'), chunks_(chunks) {
    LIGHTWELL_CHECK_OP(chunks, <=, std::size_t{most_chunks});
}

void FileAssembly::add(const std::string& tag, std::string_view content) {
    ChunkSummary entry;
    entry.tag = tag;
    entry.offset = bytes_.size();
    entry.content = content.size();
    bytes_.resize(entry.offset + ZSTD_compressBound(content.size()));
    const std::size_t packed =
        ZSTD_compress(bytes_.data() + entry.offset, bytes_.size() - entry.offset, content.data(),
                      content.size(), zstd_level);
    if (ZSTD_isError(packed))
        throw SystemError(std::string("cannot pack the operator: ") + ZSTD_getErrorName(packed));
    entry.compressed = pays(packed, content.size());
    if (!entry.compressed) bytes_.replace(entry.offset, content.size(), content);
    entry.stored = entry.compressed ? packed : content.size();
    bytes_.resize(entry.offset + entry.stored);
    entry.checksum = checksum_of(std::string_view(bytes_).substr(entry.offset));
    table_.push_back(entry);
}

const std::string& FileAssembly::finished(std::uint64_t hash_of_scene) {
    LIGHTWELL_CHECK_OP(table_.size(), ==, chunks_);
    ByteWriter head;
    head.number(file_version);
    head.count(chunks_);
    head.number(std::uint64_t{bytes_.size()});
    head.number(hash_of_scene);
    std::string bytes = std::string(file_magic) + head.bytes();
    for (const ChunkSummary& entry : table_) {
        ByteWriter numbers;
        numbers.count(entry.compressed ? 1 : 0);
        numbers.number(entry.stored);
        numbers.number(entry.content);
        numbers.number(entry.checksum);
        bytes += entry.tag + numbers.bytes();
    }
    ByteWriter checksum;
    checksum.number(checksum_of(bytes));
    bytes_.replace(0, head_bytes(chunks_), bytes + checksum.bytes());
    return bytes_;
}

}  // namespace lightwell
