#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/commands/program.h"

namespace lightwell {
namespace {

using Words = std::vector<std::string>;

constexpr int input_error = 1, system_error = 2;

/// Expects a refusal that names what is wrong, and nothing on standard output.
void expect_refused(const Words& words, const std::string& mentions) {
    const ProgramRun run = lightwell(words);
    EXPECT_EQ(run.status, input_error) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.err.rfind("lightwell: ", 0), 0u) << run.err;
    EXPECT_NE(run.err.find(mentions), std::string::npos) << run.err << " lacks " << mentions;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

TEST(CommandLine, HelpNamesEveryCommandOnStandardOutput) {
    const ProgramRun run = lightwell({"--help"});
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.err, "");
    for (const char* command : {"precompute", "info", "measure", "render"})
        EXPECT_NE(run.out.find(command), std::string::npos) << run.out;
}

TEST(CommandLine, EveryCommandHasHelpThatNamesItsOptions) {
    const std::pair<const char*, Words> commands[] = {
        {"precompute",
         {"--error", "--oracle", "--threads", "--max-memory", "--json", "--no-progress"}},
        {"info", {"--json"}},
        {"measure", {"--sensors", "--lights", "--no-gather", "--grid"}},
        {"render", {"--lights", "--camera", "--size", "--exposure", "--view"}}};
    for (const auto& [command, options] : commands) {
        const ProgramRun run = lightwell({command, "--help"});
        EXPECT_EQ(run.status, 0);
        EXPECT_NE(run.out.find(std::string("lightwell ") + command), std::string::npos) << run.out;
        for (const std::string& option : options)
            EXPECT_NE(run.out.find(option), std::string::npos) << run.out;
    }
}

TEST(CommandLine, VersionIsOneLine) {
    const ProgramRun run = lightwell({"--version"});
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.out, "lightwell " LIGHTWELL_VERSION "\n");
}

TEST(CommandLine, WrongCommandsAreNamedWithWhatExists) {
    expect_refused({}, "precompute, info, measure, render");
    expect_refused({"precomptue", "x"}, "did you mean 'precompute'?");
    expect_refused({"mesure"}, "did you mean 'measure'?");
    expect_refused({"frobnicate"}, "the commands are precompute");
}

TEST(CommandLine, WrongArgumentsAreNamed) {
    expect_refused({"precompute"}, "required");
    expect_refused({"precompute", "a.toml"}, "--output");
    expect_refused({"precompute", "a.toml", "-o", "b.gto", "--frob"}, "--frob");
    expect_refused({"info"}, "required");
    expect_refused({"info", "a", "b"}, "b");
    expect_refused({"render", "a.gto"}, "--output");
    expect_refused({"measure", "a.gto", "--sensors", "s.csv", "--grid", "g"}, "--grid");
}

struct BadValue {
    const char* option;
    const char* value;
};

class PrecomputeValues : public ::testing::TestWithParam<BadValue> {};

TEST_P(PrecomputeValues, AreRefusedByName) {
    const auto [option, value] = GetParam();
    const std::string word = std::string(option) + "=" + value;
    expect_refused({"precompute", "a.toml", "-o", "b.gto", word}, option);
    expect_refused({"precompute", "a.toml", "-o", "b.gto", word}, value);
}

INSTANTIATE_TEST_SUITE_P(
    Bad, PrecomputeValues,
    ::testing::Values(BadValue{"--error", "nan"}, BadValue{"--error", "inf"},
                      BadValue{"--error", "0"}, BadValue{"--error", "-0.1"},
                      BadValue{"--error", "0.51"}, BadValue{"--error", "0,05"},
                      BadValue{"--error", "5%"}, BadValue{"--oracle", "delphi"},
                      BadValue{"--threads", "0"}, BadValue{"--threads", "-1"},
                      BadValue{"--threads", "2.5"}, BadValue{"--threads", "99999999999999999999"},
                      BadValue{"--max-memory", "8Q"}, BadValue{"--max-memory", "nanG"},
                      BadValue{"--max-memory", "-1G"}, BadValue{"--max-memory", "1K"},
                      BadValue{"--max-memory", "1e30G"}, BadValue{"--cell-size", "0"},
                      BadValue{"--cell-size", "nan"}, BadValue{"--oracle-tolerance", "-1"},
                      BadValue{"--truncation", "inf"}));

class RenderValues : public ::testing::TestWithParam<BadValue> {};

TEST_P(RenderValues, AreRefusedByName) {
    const auto [option, value] = GetParam();
    const std::string word = std::string(option) + "=" + value;
    expect_refused({"render", "a.gto", "-o", "b.png", word}, option);
}

INSTANTIATE_TEST_SUITE_P(
    Bad, RenderValues,
    ::testing::Values(BadValue{"--size", "960"}, BadValue{"--size", "0x10"},
                      BadValue{"--size", "10x-1"}, BadValue{"--size", "10x"},
                      BadValue{"--size", "10x10x10"}, BadValue{"--size", "100000x1"},
                      BadValue{"--exposure", "nan"}, BadValue{"--exposure", "bright"},
                      BadValue{"--view", "x-ray"}, BadValue{"--samples", "0"}));

TEST(CommandLine, MessagesOfFilesCarryLineAndColumn) {
    const ScratchFolder folder;
    const std::string scene = folder.write("scene.toml", "geometry = \"a.obj\"\nunit = 7 8\n");
    const ProgramRun run = lightwell({"info", scene});
    EXPECT_EQ(run.status, input_error);
    EXPECT_EQ(run.err.rfind("lightwell: " + scene + ":2:", 0), 0u) << run.err;
}

TEST(CommandLine, FullStandardOutputIsAFailureOfTheSystem) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    ProgramSetting setting;
    setting.out_file = "/dev/full";
    const ProgramRun run = lightwell({"info", sample_scene("corner")}, setting);
    EXPECT_EQ(run.status, system_error);
    EXPECT_EQ(run.err.rfind("lightwell: standard output", 0), 0u) << run.err;
}

}  // namespace
}  // namespace lightwell
