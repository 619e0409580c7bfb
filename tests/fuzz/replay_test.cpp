// What fuzzing starts from, and what it once found: every file is read, or refused with a message.
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/commands/program.h"
#include "tests/fuzz/parsers.h"

namespace lightwell::fuzz {
namespace {

class Corpus : public ::testing::TestWithParam<Parser> {};

TEST_P(Corpus, IsReadOrRefused) {
    const ScratchFolder folder;
    folder.write("room.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl w\nf 1 2 3 4\n");
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::string(LIGHTWELL_CORPUS) +
                                                                 "/" + GetParam().name)) {
        SCOPED_TRACE(entry.path().string());
        EXPECT_NO_THROW(read_bytes_as(GetParam(), folder.path(), contents(entry.path().string())));
        ++files;
    }
    EXPECT_GE(files, 2);
}

INSTANTIATE_TEST_SUITE_P(Parsers, Corpus, ::testing::ValuesIn(parsers()),
                         [](const auto& parser) { return std::string(parser.param.name); });

}  // namespace
}  // namespace lightwell::fuzz
