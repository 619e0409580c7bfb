#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "radiance4d/operator/operator_file.h"

namespace lightwell {

// The frame of an operator file: its head and its chunks as bytes. See operator_file.h for the
// table.

constexpr std::string_view file_magic{"\x89GTO\r\n\x1a\n", 8};
constexpr std::uint32_t file_version = 1;
constexpr std::uint32_t most_chunks = 64;
constexpr std::size_t table_offset = 32;
constexpr std::size_t table_entry_bytes = 32;
/// A zstd chunk may grow this many times when it is unpacked, not more.
constexpr std::uint64_t most_growth = 256;

/// Bytes before the first chunk.
constexpr std::size_t head_bytes(std::size_t chunks) {
    return table_offset + table_entry_bytes * chunks + 8;
}

/// XXH3-64.
std::uint64_t checksum_of(std::string_view bytes);

/// Puts a file together, chunk by chunk.
class FileAssembly {
  public:
    /// The number of chunks must be known beforehand: they come behind the table.
    explicit FileAssembly(std::size_t chunks);

    /// Appends a chunk, packed if that saves at least one byte in sixteen.
    void add(const std::string& tag, std::string_view content);
    const std::vector<ChunkSummary>& table() const { return table_; }
    /// The whole file, once all chunks are there.
    const std::string& finished(std::uint64_t hash_of_scene);

  private:
    std::string bytes_;
    std::vector<ChunkSummary> table_;
    std::size_t chunks_;
};

}  // namespace lightwell
