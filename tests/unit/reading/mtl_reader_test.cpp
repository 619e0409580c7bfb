#include "solver/reading/mtl_reader.h"

#include <gtest/gtest.h>

#include "tests/unit/reading/files.h"

namespace lightwell {
namespace {

using testing::input_error_of;
using testing::TemporaryFolder;

std::vector<MaterialDescription> read(const std::string& text, std::vector<Warning>& warnings) {
    const TemporaryFolder folder;
    return read_mtl(folder.write("a.mtl", text), warnings);
}

std::string error_of(const std::string& text) {
    std::vector<Warning> warnings;
    return input_error_of([&] { read(text, warnings); });
}

TEST(MtlReader, ReadsReflectanceAndLuminance) {
    std::vector<Warning> warnings;
    const auto materials = read(
        "newmtl red wall\n Ns 10\n Kd 1 0.2 0.1 # Red\n Ke 3 4.5 6\n Ks 0 0 0\n d 1\n\n"
        "newmtl grey\nKd 0.25\nnewmtl bare\n",
        warnings);
    ASSERT_EQ(materials.size(), 3u);
    EXPECT_EQ(materials[0].name, "red wall");
    EXPECT_TRUE((*materials[0].reflectance == Rgb(1, 0.2, 0.1)).all());
    EXPECT_TRUE((*materials[0].emission == Rgb(3, 4.5, 6)).all());
    EXPECT_TRUE((*materials[1].reflectance == 0.25).all());
    EXPECT_FALSE(materials[1].emission);
    EXPECT_FALSE(materials[2].reflectance);
    EXPECT_EQ(materials[2].place.line, 10);
    EXPECT_TRUE(warnings.empty());
}

TEST(MtlReader, WarnsOfWhatItLeavesOut) {
    std::vector<Warning> warnings;
    read("newmtl a\nKd 0 0 0\nKs 0.1 0 0\nmap_Kd my tile.png\nd 0.5\nnewmtl b\nKs spectral x\n",
         warnings);
    ASSERT_EQ(warnings.size(), 3u);
    EXPECT_EQ(warnings[0].place.line, 3);
    EXPECT_EQ(warnings[0].message,
              "gloss (Ks) is not read: the surface is taken as diffuse (also at line 7)");
    EXPECT_EQ(warnings[1].place.line, 4);
    EXPECT_EQ(warnings[2].place.line, 5);
}

TEST(MtlReader, RefusesImpossibleValuesWithTheirPlace) {
    EXPECT_EQ(error_of("newmtl a\nKd 1.2 0 0\n"),
              "a.mtl:2:1: reflectance Kd 1.2 0 0 is not within 0 and 1");
    EXPECT_EQ(error_of("newmtl a\nKd 0 0 -0.1\n"),
              "a.mtl:2:1: reflectance Kd 0 0 -0.1 is not within 0 and 1");
    EXPECT_EQ(error_of("newmtl a\n  Ke 1 -2 0\n"),
              "a.mtl:2:3: emitted luminance Ke 1 -2 0 is negative or too large");
    EXPECT_EQ(error_of("newmtl a\nKd spectral a.rfl\n"), "a.mtl:2:4: 'spectral' is not a number");
    EXPECT_EQ(error_of("newmtl a\nKd 1 0\n"),
              "a.mtl:2:1: Kd has 2 numbers; one or three are needed");
    EXPECT_EQ(error_of("newmtl a\nKe 1 0 0 0\n"), "a.mtl:2:10: Ke has more than three numbers");
    EXPECT_EQ(error_of("Kd 1 1 1\n"), "a.mtl:1:1: Kd before the first newmtl");
    EXPECT_EQ(error_of("newmtl\n"), "a.mtl:1:1: newmtl without a name");
}

}  // namespace
}  // namespace lightwell
