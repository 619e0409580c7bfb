#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <signal.h>

#include "tests/commands/program.h"

namespace lightwell {
namespace {

nlohmann::json info_of(const std::string& file) {
    const ProgramRun run = lightwell({"info", file, "--json"});
    EXPECT_EQ(run.status, 0) << run.err;
    return nlohmann::json::parse(run.out);
}

double number(const nlohmann::json& info, const char* key) {
    return info.at(key).get<double>();
}

/// Interrupted when it begins with the links of its first attempt, after the preview.
ProgramRun interrupted(std::vector<std::string> arguments) {
    ProgramSetting setting;
    setting.on_terminal = true;
    setting.signal = SIGINT;
    setting.signal_at = "(links)";
    return lightwell(arguments, setting);
}

TEST(Resume, AnInterruptedComputationLeavesWhatItReachedAndGoesOnFromThere) {
    const ScratchFolder folder;
    const std::string file = folder / "box.gto";
    const ProgramRun stopped =
        interrupted({"precompute", sample_scene("cornell-box"), "-o", file, "--error", "0.02"});
    ASSERT_EQ(stopped.status, 3) << stopped.err;
    EXPECT_NE(stopped.err.find("box.gto holds what there was: 2 % asked"), std::string::npos)
        << stopped.err;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"box.gto"});
    const double coarse = number(info_of(file), "error_estimated");
    EXPECT_GT(coarse, 0.02);
    EXPECT_LT(coarse, 0.3);
    EXPECT_EQ(number(info_of(file), "error_asked"), 0.02);

    // What it has reached takes no work; what it holds is not given up for less.
    const ProgramRun enough = lightwell({"precompute", "--resume", file, "--error", "0.3"});
    EXPECT_EQ(enough.status, 0) << enough.err;
    EXPECT_NE(enough.err.find("nothing to do"), std::string::npos) << enough.err;
    const std::string before = contents(file);
    EXPECT_EQ(interrupted({"precompute", "--resume", file}).status, 3);
    EXPECT_EQ(contents(file), before);

    const ProgramRun on = lightwell({"precompute", "--resume", file, "--error", "0.06", "--json"});
    ASSERT_EQ(on.status, 0) << on.err;
    EXPECT_LE(nlohmann::json::parse(on.out).at("error_estimated").get<double>(), 0.06);
    EXPECT_EQ(number(info_of(file), "error_asked"), 0.06);
}

TEST(Resume, KeepsWhatWasSetByHandAndTheOracle) {
    const ScratchFolder folder;
    const std::string file = folder / "corner.gto", other = folder / "other.gto";
    ASSERT_EQ(lightwell({"precompute", sample_scene("corner"), "-o", file, "--error", "0.4",
                         "--cell-size", "0.7", "--oracle", "variation", "--attempts", "0"})
                  .status,
              0);
    const ProgramRun on = lightwell(
        {"precompute", "--resume", file, "-o", other, "--error", "0.3", "--attempts", "0"});
    ASSERT_EQ(on.status, 0) << on.err;
    EXPECT_EQ(number(info_of(other), "cell_size"), 0.7);
    EXPECT_EQ(info_of(other).at("oracle"), "variation");
    EXPECT_EQ(number(info_of(file), "error_asked"), 0.4);
}

// A scene with gloss keeps it, and starts tighter than a guess where the file missed its error.
TEST(Resume, GoesOnWithGlossyScenes) {
    const ScratchFolder folder;
    const std::string file = folder / "glossy.gto";
    ASSERT_EQ(lightwell({"precompute", sample_scene("glossy"), "-o", file, "--error", "0.3",
                         "--attempts", "1"})
                  .status,
              0);
    const double coarse = number(info_of(file), "error_estimated");
    const ProgramRun on =
        lightwell({"precompute", "--resume", file, "--error", "0.12", "--attempts", "1", "--json"});
    ASSERT_EQ(on.status, 0) << on.err;
    const nlohmann::json report = nlohmann::json::parse(on.out);
    EXPECT_LT(report.at("error_estimated").get<double>(), coarse);
    EXPECT_GT(report.at("gto_by_transfer").at("glossy_to_glossy").at("coefficients"), 0);
    EXPECT_EQ(number(info_of(file), "error_asked"), 0.12);
}

TEST(Resume, LearnsFromAGlossyOperatorThatMissedItsError) {
    const ScratchFolder folder;
    const std::string file = folder / "glossy.gto";
    ASSERT_EQ(lightwell({"precompute", sample_scene("glossy"), "-o", file, "--error", "0.1",
                         "--attempts", "1", "--cell-size", "0.8"})
                  .status,
              0);
    const nlohmann::json first = info_of(file);
    ASSERT_GT(number(first, "error_estimated"), 0.1);
    const ProgramRun on = lightwell({"precompute", "--resume", file, "--attempts", "1"});
    ASSERT_EQ(on.status, 0) << on.err;
    EXPECT_LT(number(info_of(file), "oracle_tolerance"), number(first, "oracle_tolerance"));
    EXPECT_EQ(number(info_of(file), "error_asked"), 0.1);
}

TEST(Resume, ReportsWhereThereIsNothingToDo) {
    const ScratchFolder folder;
    const std::string file = folder / "corner.gto", other = folder / "other.gto";
    const ProgramRun first =
        lightwell({"precompute", sample_scene("corner"), "-o", file, "--error", "0.2", "--json"});
    ASSERT_EQ(first.status, 0) << first.err;
    const ProgramRun again =
        lightwell({"precompute", "--resume", file, "-o", other, "--error", "0.3", "--json"});
    ASSERT_EQ(again.status, 0) << again.err;
    const nlohmann::json made = nlohmann::json::parse(first.out),
                         taken = nlohmann::json::parse(again.out);
    for (const char* key : {"quads", "elements", "cells", "gto_coefficients", "error_estimated"})
        EXPECT_EQ(made.at(key), taken.at(key)) << key;
    EXPECT_EQ(taken.at("attempts"), 0);
    EXPECT_EQ(info_of(other).at("scene_hash"), info_of(file).at("scene_hash"));
}

// The preview of an interrupted computation is worth less than what it went on from.
TEST(Resume, LeavesNothingWorseThanWhatItWentOnFrom) {
    const ScratchFolder folder;
    const std::string file = folder / "box.gto", other = folder / "other.gto";
    ASSERT_EQ(lightwell({"precompute", sample_scene("cornell-box"), "-o", file, "--error", "0.06"})
                  .status,
              0);
    const ProgramRun stopped =
        interrupted({"precompute", "--resume", file, "-o", other, "--error", "0.02"});
    EXPECT_EQ(stopped.status, 3) << stopped.err;
    EXPECT_NE(stopped.err.find("box.gto is as it was"), std::string::npos) << stopped.err;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"box.gto"});
}

TEST(Resume, KeepsTheOracleOfTheFileAndTakesNoOther) {
    const ScratchFolder folder;
    const std::string file = folder / "corner.gto";
    ASSERT_EQ(lightwell({"precompute", sample_scene("corner"), "-o", file, "--error", "0.4",
                         "--attempts", "0"})
                  .status,
              0);
    const ProgramRun run =
        lightwell({"precompute", "--resume", file, "--error", "0.3", "--oracle", "variation"});
    EXPECT_EQ(run.status, 1);
    EXPECT_NE(run.err.find("--oracle"), std::string::npos) << run.err;
}

TEST(Resume, NeedsASceneOrAFile) {
    const ScratchFolder folder;
    EXPECT_EQ(lightwell({"precompute"}).status, 1);
    EXPECT_EQ(lightwell({"precompute", sample_scene("corner")}).status, 1);
    EXPECT_EQ(lightwell({"precompute", sample_scene("corner"), "--resume", "x.gto"}).status, 1);
    const std::string foreign = folder.write("x.gto", "no operator");
    const ProgramRun run = lightwell({"precompute", "--resume", foreign});
    EXPECT_EQ(run.status, 1);
    EXPECT_NE(run.err.find(foreign), std::string::npos) << run.err;
    EXPECT_EQ(contents(foreign), "no operator");
}

}  // namespace
}  // namespace lightwell
