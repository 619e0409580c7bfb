#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/commands/program.h"

namespace lightwell {
namespace {

using Json = nlohmann::json;

TEST(Verify, PrintsTheErrorOfEveryWayToShowLight) {
    const ScratchFolder folder;
    const std::string file = precomputed(folder, sample_scene("cornell-box"));
    const ProgramRun run =
        lightwell({"verify", file, "--lights", "4", "--points", "8", "--seed", "5", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    const Json verdict = Json::parse(run.out);
    EXPECT_EQ(verdict.at("file"), file);
    EXPECT_EQ(verdict.at("lights"), 4);
    EXPECT_EQ(verdict.at("points"), 8);
    EXPECT_EQ(verdict.at("seed"), 5);
    EXPECT_EQ(verdict.at("error_asked"), 0.3);
    EXPECT_GT(verdict.at("rays"), 0);
    for (const char* way : {"picture", "measure", "textures"}) {
        const Json& one = verdict.at(way);
        for (const char* kind : {"indirect", "total"}) {
            const Json& size = one.at(kind);
            const Json& l2 = size.at("relative_l2");
            EXPECT_LE(l2.at("low"), l2.at("value")) << way;
            EXPECT_LE(l2.at("value"), l2.at("high")) << way;
            EXPECT_LT(l2.at("value"), 0.3) << way;
            EXPECT_TRUE(size.at("bias").contains("value"));
            for (const char* share : {"50", "90", "95", "99"}) {
                EXPECT_GE(size.at("percentiles_per_cent").at(share), 0.0);
                EXPECT_GE(size.at("percentiles_lux").at(share), 0.0);
            }
        }
        EXPECT_EQ(one.at("worst_place").at("position").size(), 3U);
        EXPECT_EQ(one.at("worst_place").at("lamp").size(), 3U);
        EXPECT_GE(one.at("worst_place").at("true_lux"), 0.0);
    }
    EXPECT_EQ(lightwell({"verify", file, "--lights", "4", "--points", "8", "--seed", "5", "--json",
                         "--threads", "1"})
                  .out,
              run.out);
}

TEST(Verify, TellsPeopleWhereItIsWorst) {
    const ScratchFolder folder;
    const std::string file = precomputed(folder, sample_scene("cornell-box"));
    const ProgramRun run = lightwell({"verify", file, "--lights", "4", "--points", "8"});
    ASSERT_EQ(run.status, 0) << run.err;
    for (const char* part : {"95 % confidence", "picture", "measure", "textures", "indirect",
                             "total", "bias", "worst", "lamp at"})
        EXPECT_NE(run.out.find(part), std::string::npos) << part;
}

TEST(Verify, RefusesWhatMakesNoSense) {
    const ScratchFolder folder;
    EXPECT_EQ(lightwell({"verify", folder / "none.gto"}).status, 1);
    EXPECT_EQ(lightwell({"verify", "x.gto", "--lights", "3"}).status, 1);
    EXPECT_EQ(lightwell({"verify", "x.gto", "--lights", "many"}).status, 1);
    EXPECT_EQ(lightwell({"verify", "x.gto", "--seed", "-1"}).status, 1);
}

TEST(Verify, NeedsAFileOrTheTableOfFailureModes) {
    const ProgramRun run = lightwell({"verify"});
    EXPECT_EQ(run.status, 1);
    EXPECT_NE(run.err.find("FILE is required, or --stability"), std::string::npos) << run.err;
}

// The first rows of the table; the rest is measured by tests of their own.
TEST(Verify, PrintsTheTableOfFailureModesUntilItIsStopped) {
    ProgramSetting setting;
    setting.signal = 2;
    setting.signal_after = 0.2;
    const ProgramRun run = lightwell({"verify", "--stability"}, setting);
    EXPECT_EQ(run.status, 3);
    EXPECT_EQ(run.out.rfind("F1 ", 0), 0U) << run.out;
    EXPECT_NE(run.out.find("met "), std::string::npos) << run.out;
    EXPECT_EQ(run.out.find("FAILED"), std::string::npos) << run.out;
}

TEST(Verify, JudgesAFileOrTheProgramButNotBothAtOnce) {
    const ProgramRun run = lightwell({"verify", "x.gto", "--stability"});
    EXPECT_EQ(run.status, 1);
    EXPECT_NE(run.err.find("--stability"), std::string::npos) << run.err;
}

TEST(Verify, StopsOnRequest) {
    const ScratchFolder folder;
    const std::string file = precomputed(folder, sample_scene("cornell-box"));
    ProgramSetting setting;
    setting.signal = 2;
    setting.signal_after = 0.5;
    const ProgramRun run = lightwell({"verify", file, "--lights", "5000"}, setting);
    EXPECT_EQ(run.status, 3);
    EXPECT_EQ(run.out, "");
}

}  // namespace
}  // namespace lightwell
