#include <chrono>
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <signal.h>
#include <unistd.h>

#include "tests/commands/program.h"

namespace lightwell {
namespace {

using Words = std::vector<std::string>;

/// Enough work that a signal after a fraction of a second meets it: the finest cells there are.
Words long_work(const std::string& output) {
    return {"precompute", sample_scene("office"), "-o", output, "--error", "0.005"};
}

TEST(Precompute, ReportsTheDocumentedKeysAsPlainNumbers) {
    const ScratchFolder folder;
    const std::string file = folder / "box.gto";
    const ProgramRun run = lightwell(
        {"precompute", sample_scene("cornell-box"), "-o", file, "--error", "0.3", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const nlohmann::json report = nlohmann::json::parse(run.out);
    for (const char* key : {"quads", "rays", "links", "dto_coefficients", "bytes", "bounces"}) {
        ASSERT_TRUE(report.contains(key)) << key;
        EXPECT_TRUE(report[key].is_number_unsigned()) << key << report[key];
        EXPECT_GT(report[key], 0) << key;
    }
    EXPECT_EQ(report["quads"], 16);
    EXPECT_EQ(report["bytes"], std::filesystem::file_size(file));
    EXPECT_EQ(report["error_asked"], 0.3);
    EXPECT_GT(report["error_estimated"], 0);
    EXPECT_LT(report["error_estimated"], 0.3);
    EXPECT_TRUE(report["energy_dropped"].is_number());
    ASSERT_EQ(report["gto_coefficients"].size(), 3u);
    for (const auto& count : report["gto_coefficients"])
        EXPECT_GT(count, 0);
    double sum = 0;
    for (const auto& [stage, seconds] : report["seconds"].items())
        if (stage != "total") sum += seconds.get<double>();
    EXPECT_NEAR(report["seconds"]["total"].get<double>(), sum, 1e-6);
}

TEST(Precompute, WithoutAttemptsTheErrorIsNotEstimated) {
    const ScratchFolder folder;
    const ProgramRun run = lightwell({"precompute", sample_scene("corner"), "-o", folder / "c.gto",
                                      "--error", "0.3", "--attempts", "0", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(nlohmann::json::parse(run.out)["error_estimated"], 0);
}

/// A glossy floor below a ceiling, as a scene file.
std::string glossy_scene(const ScratchFolder& folder, const std::string& specular,
                         const std::string& exponent = "10", const std::string& diffuse = "0.7") {
    folder.write("two.obj",
                 "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                 "usemtl floor\nf 1 2 3 4\nusemtl top\nf 8 7 6 5\n");
    return folder.write("scene.toml",
                        "geometry = \"two.obj\"\n[material.top]\nreflectance = 0.5\n"
                        "[material.floor]\nreflectance = " +
                            diffuse + "\nexponent = " + exponent + "\nspecular = " + specular +
                            "\n");
}

TEST(Precompute, SaysWhereItCannotFollowALobe) {
    const ScratchFolder folder;
    Words words = {"precompute", glossy_scene(folder, "0.2"),
                   "-o",         folder / "g.gto",
                   "--error",    "0.3",
                   "--attempts", "0"};
    const ProgramRun wide = lightwell(words);
    ASSERT_EQ(wide.status, 0) << wide.err;
    EXPECT_EQ(wide.err, "");
    words[1] = glossy_scene(folder, "0.8", "5000", "0.1");
    const ProgramRun sharp = lightwell(words);
    ASSERT_EQ(sharp.status, 0) << sharp.err;
    EXPECT_NE(sharp.err.find("lightwell: warning: 'floor': its reflections are too sharp"),
              std::string::npos)
        << sharp.err;
    EXPECT_EQ(lightwell({"measure", folder / "g.gto", "--probes",
                         folder.write("p.csv", "0.5,0.5,0.5,0,0.6,-0.8\n"), "--no-gather"})
                  .out.substr(0, 14),
              "x,y,z,dx,dy,dz");
}

// Lamps near a glossy floor, with their light's direction and without it.
TEST(Precompute, LetsOneCompareWithLampsThatLoseTheirDirection) {
    const ScratchFolder folder;
    ASSERT_EQ(lightwell({"precompute", glossy_scene(folder, "0.2"), "-o", folder / "g.gto",
                         "--error", "0.3", "--attempts", "0"})
                  .status,
              0);
    const std::string probes = folder.write("p.csv", "0.5,0.5,0.5,0,0.6,0.8\n");
    const std::string lamp =
        folder.write("l.toml",
                     "[[light]]\nname = \"l\"\ntype = \"point\"\nposition = [0.1, 0.1, 0.1]\n"
                     "intensity = 100\n");
    Words words = {"measure", folder / "g.gto", "--probes", probes, "--lights",
                   lamp,      "--no-gather"};
    const ProgramRun kept = lightwell(words);
    words.emplace_back("--spread-lamps");
    const ProgramRun spread = lightwell(words);
    EXPECT_EQ(kept.status + spread.status, 0) << kept.err << spread.err;
    EXPECT_NE(kept.out, spread.out);
    EXPECT_EQ(lightwell({"measure", folder / "g.gto", "--probes", probes, "--spread-lamps"}).status,
              1);
}

TEST(Precompute, SaysWhatBrightMaterialsDo) {
    const ScratchFolder folder;
    const std::string scene = folder.write(
        "two.obj",
        "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\n"
        "v 0 1 1\nusemtl snow\nf 1 2 3 4\nusemtl top\nf 8 7 6 5\n");
    folder.write("two.mtl", "newmtl snow\nKd 0.97 0.97 0.97\nnewmtl top\nKd 0.5 0.5 0.5\n");
    const Words words = {"precompute", scene, "-o",         folder / "two.gto",
                         "--error",    "0.3", "--attempts", "0"};
    const ProgramRun run = lightwell(words);
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.err.find("warning: 'snow': more than 95 %"), std::string::npos) << run.err;
}

TEST(Precompute, RefusesOrScalesWhatMakesLight) {
    const ScratchFolder folder;
    Words words = {"precompute", glossy_scene(folder, "0.5"),
                   "-o",         folder / "g.gto",
                   "--error",    "0.3",
                   "--attempts", "0"};
    const ProgramRun refused = lightwell(words);
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find("reflects more light than it receives: 1.2 of the red at 0 degrees"),
              std::string::npos)
        << refused.err;
    words.emplace_back("--scale-albedo");
    const ProgramRun scaled = lightwell(words);
    EXPECT_EQ(scaled.status, 0) << scaled.err;
    EXPECT_NE(scaled.err.find("are scaled by 0.8333"), std::string::npos) << scaled.err;
}

TEST(Precompute, SummaryGoesToStandardOutputAndNothingToTheOther) {
    const ScratchFolder folder;
    const ProgramRun run =
        lightwell({"precompute", sample_scene("corner"), "-o", folder / "c.gto", "--error", "0.3"});
    ASSERT_EQ(run.status, 0) << run.err;
    for (const char* word : {"quads", "rays", "links", "coefficients", "bounces", "error asked",
                             "estimated", "seconds", "dropped"})
        EXPECT_NE(run.out.find(word), std::string::npos) << word << " in " << run.out;
    EXPECT_EQ(run.err, "");
    EXPECT_EQ(folder.names(), Words{"c.gto"});
}

TEST(Precompute, QuietIsSilent) {
    const ScratchFolder folder;
    const std::string bare =
        folder.write("bare.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    const ProgramRun loud = lightwell({"precompute", bare, "-o", folder / "a.gto"});
    EXPECT_EQ(loud.status, 0);
    EXPECT_EQ(loud.err.rfind("lightwell: " + bare, 0), 0u) << loud.err;
    EXPECT_NE(loud.err.find("warning: "), std::string::npos) << "the missing material";
    const ProgramRun quiet = lightwell({"precompute", bare, "-o", folder / "a.gto", "-q"});
    EXPECT_EQ(quiet.status, 0);
    EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST(Precompute, AFolderWithASceneFileIsAScene) {
    const ScratchFolder folder;
    const std::string corner = std::filesystem::path(sample_scene("corner")).parent_path();
    EXPECT_EQ(lightwell({"precompute", corner, "-o", folder / "c.gto", "--error", "0.3"}).status,
              0);
    EXPECT_EQ(lightwell({"precompute", folder.path(), "-o", folder / "d.gto"}).status, 1);
}

TEST(Precompute, BytesAreTheSameForAnyNumberOfThreads) {
    const ScratchFolder folder;
    std::string first;
    for (const char* threads : {"1", "2", "5"}) {
        const std::string file = folder / threads;
        const ProgramRun run =
            lightwell({"precompute", sample_scene("cornell-box"), "-o", file, "--error", "0.3",
                       "--attempts", "0", "--threads", threads});
        ASSERT_EQ(run.status, 0) << run.err;
        const std::string bytes = contents(file);
        if (first.empty()) first = bytes;
        EXPECT_EQ(bytes, first) << threads << " threads";
    }
}

TEST(Precompute, ErrorsAreToldApartAndLeaveNothing) {
    const ScratchFolder folder;
    const std::string output = folder / "x.gto";
    // The user's mistakes.
    EXPECT_EQ(lightwell({"precompute", folder / "none.toml", "-o", output}).status, 1);
    EXPECT_EQ(lightwell({"precompute", sample_scene("corner"), "-o", folder / "no/x.gto"}).status,
              1);
    EXPECT_EQ(lightwell({"precompute", sample_scene("corner"), "-o", folder.path()}).status, 1);
    const std::string broken = folder.write("broken.obj", "v 0 0 0\nv 1 0\n");
    const ProgramRun run = lightwell({"precompute", broken, "-o", output});
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.err.rfind("lightwell: " + broken + ":2:", 0), 0u) << run.err;
    EXPECT_EQ(folder.names(), Words{"broken.obj"});
}

TEST(Precompute, AFailureKeepsWhatWasThere) {
    const ScratchFolder folder;
    const std::string output = folder.write("x.gto", "precious");
    EXPECT_EQ(lightwell({"precompute", folder / "none.toml", "-o", output}).status, 1);
    EXPECT_EQ(contents(output), "precious");
}

TEST(Precompute, AFolderThatTakesNoFileIsToldBeforeTheWork) {
    const ScratchFolder folder;
    std::filesystem::permissions(
        folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    std::string output = folder / "x.gto";
    // Root may write anywhere but on a system that takes no files at all.
    if (geteuid() == 0) output = "/sys/kernel/x.gto";
    const auto start = std::chrono::steady_clock::now();
    const ProgramRun run = lightwell(long_work(output));
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_NE(run.err.find(output), std::string::npos) << run.err;
    EXPECT_LT(passed.count(), 5);
}

class Interruption : public ::testing::TestWithParam<int> {};

/// Nothing, or what there was already: a whole file.
void expect_nothing_half(const ScratchFolder& folder) {
    if (folder.names().empty()) return;
    EXPECT_EQ(folder.names(), Words{"x.gto"});
    EXPECT_EQ(lightwell({"info", folder / "x.gto"}).status, 0);
}

TEST_P(Interruption, StopsCleanlyAndLeavesNothingHalf) {
    const ScratchFolder folder;
    ProgramSetting setting;
    setting.signal = GetParam();
    setting.signal_after = 0.5;
    const auto start = std::chrono::steady_clock::now();
    const ProgramRun run = lightwell(long_work(folder / "x.gto"), setting);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(run.status, 3) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.err.rfind("lightwell: ", 0), 0u) << run.err;
    expect_nothing_half(folder);
    EXPECT_LT(passed.count(), 10) << "stopping took too long";
}

INSTANTIATE_TEST_SUITE_P(Signals, Interruption, ::testing::Values(SIGINT, SIGTERM));

class LateInterruption : public ::testing::TestWithParam<const char*> {};

// The terminal shows which stage is at work; the signal comes when it shows this one.
TEST_P(LateInterruption, StopsCleanlyAndLeavesNothingHalf) {
    const ScratchFolder folder;
    ProgramSetting setting;
    setting.on_terminal = true;
    setting.signal = SIGINT;
    setting.signal_at = std::string("(") + GetParam() + ")";
    const ProgramRun run = lightwell(
        {"precompute", sample_scene("cornell-box"), "-o", folder / "x.gto", "--error", "0.03"},
        setting);
    EXPECT_NE(run.err.find(setting.signal_at), std::string::npos) << run.err;
    EXPECT_EQ(run.status, 3) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_NE(run.err.find("lightwell: stopped on request"), std::string::npos) << run.err;
    expect_nothing_half(folder);
}

INSTANTIATE_TEST_SUITE_P(Stages, LateInterruption,
                         ::testing::Values("operator", "series", "estimate"));

TEST(Precompute, WhatWasThereOutlivesAnInterruption) {
    const ScratchFolder folder;
    const std::string output = folder.write("x.gto", "precious");
    ProgramSetting setting;
    setting.signal = SIGINT;
    setting.signal_after = 0.3;
    EXPECT_EQ(lightwell(long_work(output), setting).status, 3);
    EXPECT_EQ(folder.names(), Words{"x.gto"});
    EXPECT_EQ(contents(output), "precious");
}

TEST(Precompute, MoreMemoryThanAllowedIsToldBeforeTheWork) {
    const ScratchFolder folder;
    const ProgramRun run = lightwell(
        {"precompute", sample_scene("maze"), "-o", folder / "x.gto", "--max-memory", "64M"});
    EXPECT_EQ(run.status, 1) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_NE(run.err.find("cells"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("allowed are 64 MiB"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("--max-memory"), std::string::npos) << run.err;
    EXPECT_TRUE(folder.names().empty());
}

// Attempts take more and more links; one that does not fit is not made, and what there is already
// is kept.
TEST(Precompute, AnAttemptThatDoesNotFitIsNotMade) {
    const ScratchFolder folder;
    const auto report = [&](const Words& more) {
        Words words = {"precompute",   sample_scene("cornell-box"),
                       "-o",           folder / "x.gto",
                       "--error",      "0.05",
                       "--truncation", "0.3",
                       "--json"};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramRun run = lightwell(words);
        EXPECT_EQ(run.status, 0) << run.err;
        return nlohmann::json::parse(run.out);
    };
    const nlohmann::json first = report({"--attempts", "1"});
    const nlohmann::json free = report({"--attempts", "2"});
    ASSERT_GT(free["links"], first["links"]) << "no attempt took more links";
    const int enough = 20500 * first["cells"].get<int>();
    const nlohmann::json bound =
        report({"--attempts", "2", "--max-memory", std::to_string(enough)});
    EXPECT_EQ(bound["links"], first["links"]);
    EXPECT_LT(bound["attempts"], free["attempts"]);
}

// What is set by hand stays: with nothing left to tighten there is no second attempt.
TEST(Precompute, NothingIsComputedAgainWithTheSameSettings) {
    const ScratchFolder folder;
    const ProgramRun run = lightwell(
        {"precompute", sample_scene("cornell-box"), "-o", folder / "x.gto", "--error", "0.05",
         "--truncation", "0.3", "--oracle-tolerance", "0.001", "--cell-size", "0.5", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const nlohmann::json report = nlohmann::json::parse(run.out);
    EXPECT_GT(report["error_estimated"], 0.05);
    EXPECT_EQ(report["attempts"], 1);
}

// All pairs of cells exchange light by some way: without truncation the operator is dense.
TEST(Precompute, WithoutTruncationTheMemoryOfADenseOperatorIsRequired) {
    const ScratchFolder folder;
    Words words = {"precompute",   sample_scene("cornell-box"),
                   "-o",           folder / "x.gto",
                   "--error",      "0.1",
                   "--attempts",   "0",
                   "--max-memory", "256M"};
    EXPECT_EQ(lightwell(words).status, 0);
    words.insert(words.end(), {"--truncation", "0"});
    const ProgramRun refused = lightwell(words);
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find("--truncation 0"), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("allowed are 256 MiB"), std::string::npos) << refused.err;
    EXPECT_EQ(folder.names(), Words{"x.gto"});
}

// Without a lamp to tell what may be left out nothing is.
TEST(Precompute, WithoutRoomForALampTheMemoryOfADenseOperatorIsRequired) {
    const ScratchFolder folder;
    const std::string plates = folder.write("plates.obj",
                                            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                            "v 0 0 10\nv 0 1 10\nv 1 1 10\nv 1 0 10\n"
                                            "f 1 2 3 4\nf 5 6 7 8\n");
    const ProgramRun refused = lightwell({"precompute", plates, "-o", folder / "x.gto", "--error",
                                          "0.1", "--cell-size", "0.02", "--max-memory", "1G"});
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find("8192 cells"), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("allowed are 1.0 GiB"), std::string::npos) << refused.err;
}

TEST(Precompute, WithoutTruncationAWarningComesFirst) {
    const ScratchFolder folder;
    Words words = {"precompute",   sample_scene("corner"),
                   "-o",           folder / "x.gto",
                   "--error",      "0.5",
                   "--attempts",   "0",
                   "--cell-size",  "1",
                   "--truncation", "0"};
    const ProgramRun run = lightwell(words);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.err.find("warning: --truncation 0"), std::string::npos) << run.err;
    words.push_back("-q");
    EXPECT_EQ(lightwell(words).err, "");
}

// What was asked for and could not be judged is not passed over.
TEST(Precompute, SaysWhereTheErrorCannotBeJudged) {
    const ScratchFolder folder;
    const std::string plates =
        folder.write("plates.obj",
                     "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                     "v 0 0 10\nv 0 1 10\nv 1 1 10\nv 1 0 10\nf 1 2 3 4\nf 5 6 7 8\n");
    const Words words = {"precompute", plates, "-o", folder / "x.gto", "--error", "0.2"};
    const ProgramRun judged = lightwell(words);
    EXPECT_EQ(judged.status, 0);
    EXPECT_NE(judged.err.find("the error is not known"), std::string::npos) << judged.err;
    Words unjudged = words;
    unjudged.insert(unjudged.end(), {"--attempts", "0"});
    EXPECT_EQ(lightwell(unjudged).err.find("not known"), std::string::npos);
    const ProgramRun verified = lightwell({"verify", folder / "x.gto"});
    EXPECT_EQ(verified.status, 1);
    EXPECT_NE(verified.err.find("no place for a lamp"), std::string::npos) << verified.err;
}

// Few samples a link may find more light than there is; a series of such bounces has no sum.
TEST(Precompute, SaysWhereBouncesHaveNoSum) {
    const ScratchFolder folder;
    const std::string file = folder / "x.gto";
    const ProgramRun run =
        lightwell({"precompute", sample_scene("maze"), "-o", file, "--oracle", "variation",
                   "--oracle-tolerance", "0.03", "--error", "0.1", "--attempts", "0"});
    EXPECT_EQ(run.status, 1);
    EXPECT_NE(run.err.find("no sum"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(Progress, IsShownOnATerminalOnly) {
    const ScratchFolder folder;
    ProgramSetting terminal;
    terminal.on_terminal = true;
    Words words = {"precompute", sample_scene("cornell-box"),
                   "-o",         folder / "c.gto",
                   "--error",    "0.2",
                   "--attempts", "0"};
    const ProgramRun shown = lightwell(words, terminal);
    EXPECT_EQ(shown.status, 0);
    EXPECT_NE(shown.err.find(" %"), std::string::npos) << shown.err;
    EXPECT_EQ(lightwell(words).err, "");
    words.push_back("--no-progress");
    EXPECT_EQ(lightwell(words, terminal).err, "");
    words.back() = "-q";
    EXPECT_EQ(lightwell(words, terminal).err, "");
}

}  // namespace
}  // namespace lightwell
