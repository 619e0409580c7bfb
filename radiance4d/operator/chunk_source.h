#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "radiance4d/operator/file_layout.h"

namespace lightwell {

/// Bytes that are not cleared first.
class ChunkContent {
  public:
    explicit ChunkContent(std::size_t size) : bytes_(new char[size]), size_(size) {}
    char* begin() { return bytes_.get(); }
    std::string_view view() const { return {bytes_.get(), size_}; }

  private:
    std::unique_ptr<char[]> bytes_;
    std::size_t size_;
};

/// An operator file opened for reading, its head checked: lengths add up to the file's size before
/// memory is taken for anything. Const methods may be called from
/// several threads.
class ChunkSource {
  public:
    /// @throws InputError if the file cannot be opened or its head is not that of an operator file
    explicit ChunkSource(const std::string& path);
    ~ChunkSource();
    ChunkSource(const ChunkSource&) = delete;
    ChunkSource& operator=(const ChunkSource&) = delete;

    const std::vector<ChunkSummary>& chunks() const { return chunks_; }
    std::uint32_t version() const { return version_; }
    std::uint64_t bytes() const { return bytes_; }
    std::uint64_t scene_hash() const { return scene_hash_; }

    /// How many chunks have this tag.
    std::size_t count(std::string_view tag) const;
    /// The n-th chunk of a tag, which is there.
    const ChunkSummary& chunk(std::string_view tag, std::size_t nth = 0) const;
    /// Reads a chunk as it is stored and compares its checksum. @throws InputError if it is damaged
    ChunkContent stored(const ChunkSummary& chunk) const;
    /// The same, unpacked.
    ChunkContent content(const ChunkSummary& chunk) const;
    /// "room.gto: damaged operator file: chunk SCEN (bytes 392 to 790)", for messages.
    std::string place(const ChunkSummary& chunk) const;

  private:
    void open();
    void read_head();
    void read_table(std::string_view table);
    /// Reads into `target` and returns the checksum of what was read.
    std::uint64_t read(std::uint64_t offset, char* target, std::size_t size) const;
    [[noreturn]] void refuse(const std::string& why) const;

    std::string path_;
    int descriptor_ = -1;
    std::uint32_t version_ = 0;
    std::uint64_t bytes_ = 0;
    std::uint64_t scene_hash_ = 0;
    std::vector<ChunkSummary> chunks_;
};

}  // namespace lightwell
