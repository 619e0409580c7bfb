// One libFuzzer target for all parsers: LIGHTWELL_PARSER in the environment says which.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <unistd.h>

#include "tests/fuzz/parsers.h"

namespace {

/// A folder in memory, removed at the end.
struct Scratch {
    Scratch() {
        const bool has_memory = std::filesystem::is_directory("/dev/shm");
        std::string name = std::string(has_memory ? "/dev/shm" : "/tmp") + "/lightwell-fuzz-XXXXXX";
        if (mkdtemp(name.data()) == nullptr) std::abort();
        path = name;
        std::FILE* geometry = std::fopen((path + "/room.obj").c_str(), "w");
        std::fputs("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl w\nf 1 2 3 4\n", geometry);
        std::fclose(geometry);
    }
    ~Scratch() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    std::string path;
};

const lightwell::fuzz::Parser& chosen() {
    const char* name = std::getenv("LIGHTWELL_PARSER");
    const auto* parser = name == nullptr ? nullptr : lightwell::fuzz::parser_named(name);
    if (parser == nullptr) {
        std::fputs("LIGHTWELL_PARSER must be one of:", stderr);
        for (const auto& one : lightwell::fuzz::parsers())
            std::fprintf(stderr, " %s", one.name);
        std::fputs("\n", stderr);
        std::exit(1);
    }
    return *parser;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    static const Scratch scratch;
    static const lightwell::fuzz::Parser& parser = chosen();
    lightwell::fuzz::read_bytes_as(parser, scratch.path,
                                   std::string(reinterpret_cast<const char*>(bytes), size));
    return 0;
}
