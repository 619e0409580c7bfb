#include "solver/reading/mtl_reader.h"

#include <gtest/gtest.h>

#include "tests/scratch_folder.h"
#include "tests/unit/reading/files.h"

namespace lightwell {
namespace {

using testing::input_error_of;
using testing::ScratchFolder;

std::vector<MaterialDescription> read(const std::string& text, std::vector<Warning>& warnings) {
    const ScratchFolder folder;
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

TEST(MtlReader, ReadsTheHighlight) {
    std::vector<Warning> warnings;
    const auto materials = read(
        "newmtl a\nKs 0.1 0.2 0.3\nNs 32\n\nillum 2\nnewmtl b\nKs 0.5\nillum 1\nNs 4\n"
        "newmtl c\nKs 0.5\nNs 4\nnewmtl d\nillum 0\nKs 1\n",
        warnings);
    ASSERT_EQ(materials.size(), 4u);
    EXPECT_TRUE((*materials[0].specular == Rgb(0.1, 0.2, 0.3)).all());
    EXPECT_EQ(*materials[0].exponent, 32);
    EXPECT_FALSE(materials[0].roughness);
    EXPECT_FALSE(materials[1].specular);  // lighting model 1 has no highlight
    EXPECT_TRUE((*materials[2].specular == 0.5).all());
    EXPECT_FALSE(materials[3].specular);  // nor has 0
    EXPECT_TRUE(warnings.empty());
}

TEST(MtlReader, WarnsOfWhatItLeavesOut) {
    std::vector<Warning> warnings;
    read("newmtl a\nKd 0 0 0\nmap_Kd my tile.png\nd 0.5\nnewmtl b\nd 0\n", warnings);
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_EQ(warnings[0].place.line, 3);
    EXPECT_EQ(warnings[1].place.line, 4);
    EXPECT_EQ(warnings[1].message,
              "transparency (d) is not read: the surface is taken as opaque (also at line 6)");
}

TEST(MtlReader, RefusesImpossibleValuesWithTheirPlace) {
    EXPECT_EQ(error_of("newmtl a\nKd 1.2 0 0\n"),
              "a.mtl:2:1: reflectance Kd 1.2 0 0 is not within 0 and 1");
    EXPECT_EQ(error_of("newmtl a\nKd 0 0 -0.1\n"),
              "a.mtl:2:1: reflectance Kd 0 0 -0.1 is not within 0 and 1");
    EXPECT_EQ(error_of("newmtl a\nKs 0 0 1.1\n"),
              "a.mtl:2:1: reflectance Ks 0 0 1.1 is not within 0 and 1");
    EXPECT_EQ(error_of("newmtl a\nNs -1\n"), "a.mtl:2:1: exponent Ns -1 is not within 0 and 10000");
    EXPECT_EQ(error_of("newmtl a\nNs\n"), "a.mtl:2:3: the exponent is missing");
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
