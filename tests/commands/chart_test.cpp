#include <filesystem>

#include <gtest/gtest.h>

#include "tests/commands/program.h"

namespace lightwell {
namespace {

TEST(Chart, DrawsASceneIntoAFolder) {
    const ScratchFolder folder;
    const std::string charts = folder / "new/charts";
    const ProgramRun run =
        lightwell({"chart", sample_scene("two-rooms"), "-o", charts, "--quick", "--no-progress"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    const std::string page = contents(charts + "/index.html");
    for (const char* part :
         {"default: gathered", "default: G stored", "default: T iterated",
          "default, with its judging", "default by hand: gathered", "cells x 2",
          "paper's oracle: gathered", "compute and compress: gathered",
          "path tracing in every frame", "best N coefficients of G by weight", "after WRT figure 4",
          "after WRT figure 6", "after WRT figure 7", "after WRT figure 8", "Made by lightwell",
          "the knee", "The cheapest frame for each error"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    for (const char* chart : {"error-precompute", "error-rays", "error-coefficients",
                              "error-memory", "error-frame", "gathered", "powers", "thresholds"}) {
        EXPECT_EQ(contents(charts + "/" + chart + ".svg").rfind("<svg ", 0), 0U) << chart;
        EXPECT_EQ(contents(charts + "/" + chart + ".csv").rfind("series,", 0), 0U) << chart;
    }
    EXPECT_EQ(contents(charts + "/measured.csv").rfind("method,setting,error,", 0), 0U);
}

TEST(Chart, NeedsASceneAndAFolder) {
    const ScratchFolder folder;
    EXPECT_EQ(lightwell({"chart", sample_scene("corner")}).status, 1);
    EXPECT_EQ(lightwell({"chart", folder / "none.toml", "-o", folder / "charts"}).status, 1);
    const std::string file = folder.write("file", "text");
    EXPECT_EQ(lightwell({"chart", sample_scene("corner"), "-o", file, "--quick"}).status, 1);
}

TEST(Chart, LeavesNothingWhereItFailsAndTouchesNothingOfOthers) {
    const ScratchFolder folder;
    const std::string plate = folder.write("plate.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    const ProgramRun none = lightwell({"chart", plate, "-o", folder / "a/charts", "--quick"});
    EXPECT_EQ(none.status, 1);
    EXPECT_NE(none.err.find("no place for a lamp"), std::string::npos) << none.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "a/charts"));

    const std::string precious = folder.write("operator.gto", "precious");
    EXPECT_EQ(lightwell({"chart", plate, "-o", folder.path(), "--quick"}).status, 1);
    EXPECT_EQ(contents(precious), "precious");

    EXPECT_EQ(lightwell({"chart", plate, "-o", "/proc/charts", "--quick"}).status, 2);
    EXPECT_EQ(lightwell({"chart", plate, "-o", plate + "/charts", "--quick"}).status, 1);
    EXPECT_EQ(lightwell({"chart", plate, "-o", "", "--quick"}).status, 1);
}

TEST(Chart, StopsOnRequest) {
    const ScratchFolder folder;
    ProgramSetting setting;
    setting.signal = 2;
    setting.signal_after = 0.5;
    EXPECT_EQ(
        lightwell({"chart", sample_scene("cornell-box"), "-o", folder / "charts"}, setting).status,
        3);
}

}  // namespace
}  // namespace lightwell
