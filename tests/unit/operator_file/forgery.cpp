#include "tests/unit/operator_file/forgery.h"

#include <cstring>

#include "radiance4d/operator/chunk_source.h"
#include "radiance4d/operator/file_layout.h"
#include "tests/unit/operator_file/sample_transport.h"

namespace lightwell::testing {

void forge(const std::string& from, const std::string& to,
           const std::function<void(std::string& tag, std::string& content)>& change) {
    const ChunkSource source(from);
    FileAssembly file(source.chunks().size());
    std::uint64_t hash = source.scene_hash();
    for (const ChunkSummary& chunk : source.chunks()) {
        std::string tag = chunk.tag;
        std::string content(source.content(chunk).view());
        change(tag, content);
        file.add(tag, content);
        if (tag == "SCEN") hash = checksum_of(content);
    }
    put_bytes(to, file.finished(hash));
}

std::string with_valid_head(std::string bytes) {
    std::uint32_t chunks = 0;
    std::memcpy(&chunks, bytes.data() + 12, 4);
    const std::size_t covered = head_bytes(chunks) - 8;
    const std::uint64_t checksum = checksum_of(std::string_view(bytes).substr(0, covered));
    std::memcpy(bytes.data() + covered, &checksum, 8);
    return bytes;
}

}  // namespace lightwell::testing
