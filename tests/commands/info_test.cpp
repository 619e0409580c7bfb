#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/commands/program.h"

namespace lightwell {
namespace {

TEST(Info, OfASceneCountsAndDiagnoses) {
    const ProgramRun run = lightwell({"info", sample_scene("cornell-box")});
    ASSERT_EQ(run.status, 0) << run.err;
    for (const char* words : {"16 faces: 16 quads", "lamp", "degenerate", "open"})
        EXPECT_NE(run.out.find(words), std::string::npos) << words << " in " << run.out;
}

TEST(Info, OfASceneIsJson) {
    const ProgramRun run = lightwell({"info", sample_scene("maze"), "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const nlohmann::json info = nlohmann::json::parse(run.out);
    EXPECT_EQ(info["kind"], "scene");
    EXPECT_EQ(info["quads"], info["faces"]);
    EXPECT_EQ(info["diagnosis"]["degenerate_quads"]["count"], 0);
    EXPECT_TRUE(info["warnings"].is_array());
}

TEST(Info, SaysWhatItAssumesOfBareGeometry) {
    const ScratchFolder folder;
    const std::string file =
        folder.write("one.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    ProgramRun run = lightwell({"info", file});
    EXPECT_NE(run.err.find("assumed that lengths are in metres and z points up"), std::string::npos)
        << run.err;
    run = lightwell({"info", file, "--unit", "cm", "--up", "y"});
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.err, "");
    EXPECT_EQ(lightwell({"info", file, "--unit", "0.3048"}).status, 0);
    for (const char* unit : {"yard", "0", "-1", "1e10", "nan"})
        EXPECT_EQ(lightwell({"info", file, "--unit", unit}).status, 1) << unit;
    EXPECT_EQ(lightwell({"info", file, "--up", "w"}).status, 1);
    EXPECT_EQ(lightwell({"info", sample_scene("maze"), "--unit", "cm"}).status, 1);
}

TEST(Info, CountsWhatIsWrongWithAScene) {
    const ScratchFolder folder;
    const std::string file =
        folder.write("twice.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 1 2 3 4\n");
    const ProgramRun run = lightwell({"info", file, "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const nlohmann::json duplicates =
        nlohmann::json::parse(run.out)["diagnosis"]["duplicate_quads"];
    EXPECT_EQ(duplicates["count"], 1);
    EXPECT_EQ(duplicates["left_out"], 1);
}

TEST(Info, OfAnOperatorAgreesWithTheReportOfItsMaking) {
    const ScratchFolder folder;
    const std::string file = folder / "c.gto";
    const ProgramRun made =
        lightwell({"precompute", sample_scene("corner"), "-o", file, "--error", "0.2", "--json"});
    ASSERT_EQ(made.status, 0) << made.err;
    const nlohmann::json report = nlohmann::json::parse(made.out);
    const ProgramRun run = lightwell({"info", file, "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const nlohmann::json info = nlohmann::json::parse(run.out);
    EXPECT_EQ(info["kind"], "operator");
    for (const char* key : {"quads", "rays", "links", "dto_coefficients", "gto_coefficients",
                            "bytes", "bounces", "error_asked", "elements", "cells", "cell_size"})
        EXPECT_EQ(info[key], report[key]) << key;
    EXPECT_EQ(info["options"]["error"], 0.2);
    const ProgramRun text = lightwell({"info", file});
    EXPECT_EQ(text.status, 0);
    EXPECT_NE(text.out.find("20 %"), std::string::npos) << text.out;
}

TEST(Info, DamageAndForeignFilesAreToldNotBelieved) {
    const ScratchFolder folder;
    std::string bytes = contents(precomputed(folder, sample_scene("corner")));
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
    for (const std::string& file :
         {folder.write("damaged.gto", bytes), folder.write("text.gto", "hello"),
          folder.write("empty.gto", ""), folder.write("picture.jpg", "\xff\xd8"),
          folder / "none"}) {
        const ProgramRun run = lightwell({"info", file});
        EXPECT_EQ(run.status, 1) << file;
        EXPECT_EQ(run.out, "");
        EXPECT_EQ(run.err.rfind("lightwell: " + file, 0), 0u) << run.err;
    }
}

}  // namespace
}  // namespace lightwell
