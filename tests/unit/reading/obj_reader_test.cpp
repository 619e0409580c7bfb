#include "solver/reading/obj_reader.h"

#include <gtest/gtest.h>

#include "tests/scratch_folder.h"
#include "tests/unit/reading/files.h"

namespace lightwell {
namespace {

using testing::input_error_of;
using testing::ScratchFolder;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

PolygonSoup read(const std::string& text) {
    const ScratchFolder folder;
    return read_obj(folder.write("a.obj", text));
}

std::string error_of(const std::string& text) {
    return input_error_of([&] { read(text); });
}

TEST(ObjReader, KeepsAllDigitsOfADouble) {
    const PolygonSoup soup =
        read("v 0.123456789012345 100000.123456789 -1e-3\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    EXPECT_EQ(soup.vertices[0], Vec3(0.123456789012345, 100000.123456789, -1e-3));
}

TEST(ObjReader, KnowsEveryFormOfACorner) {
    const PolygonSoup soup = read(square + "f 1 2/1 3//1 4/1/1\nf -4 -3/ -2// -1\n");
    EXPECT_EQ(soup.corners, (std::vector<int>{0, 1, 2, 3, 0, 1, 2, 3}));
    ASSERT_EQ(soup.polygons.size(), 2u);
    EXPECT_EQ(soup.polygons[1].first, 4);
    EXPECT_EQ(soup.polygons[1].count, 4);
    EXPECT_EQ(soup.polygons[1].line, 6);
}

TEST(ObjReader, AcceptsPlusSignsDotsAndExponents) {
    const PolygonSoup soup = read("v +1 +2. .5e+01\nv 1E2 0 0\nv 0 1e-400 0\nf 1 2 3\n");
    EXPECT_EQ(soup.vertices[0], Vec3(1, 2, 5));
    EXPECT_EQ(soup.vertices[1], Vec3(100, 0, 0));
    EXPECT_EQ(soup.vertices[2], Vec3(0, 0, 0));
}

TEST(ObjReader, EndsLinesInAnyWay) {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        const PolygonSoup soup = read("v 0 0 0" + end + "v 1 0 0" + end + "v 1 1 0 # corner" + end +
                                      end + "f 1 2 \\" + end + " 3");
        EXPECT_EQ(soup.corners, (std::vector<int>{0, 1, 2}));
        EXPECT_EQ(soup.polygons[0].line, 5);
    }
}

TEST(ObjReader, CountsLinesOnAfterAContinuation) {
    EXPECT_EQ(error_of(square + "f 1 2 \\\n 3 \\\n x\n"), "a.obj:7:2: 'x' is not a whole number");
}

TEST(ObjReader, SkipsAByteOrderMark) {
    EXPECT_EQ(read("\xef\xbb\xbf" + square + "f 1 2 3 4\n").vertices.size(), 4u);
}

TEST(ObjReader, RefusesUtf16) {
    EXPECT_EQ(error_of(std::string("\xff\xfev\0 \0", 6)),
              "a.obj:1:1: is not UTF-8 text (it looks like UTF-16 or like a binary file); save it "
              "as UTF-8");
}

TEST(ObjReader, IgnoresVertexColoursAndWeights) {
    const PolygonSoup soup = read("v 0 0 0 1\nv 1 0 0 nan nan nan\nv 1 1 0 255 0 0\nf 1 2 3\n");
    EXPECT_EQ(soup.vertices.size(), 3u);
}

TEST(ObjReader, NumbersMaterialsByTheirFirstUse) {
    const PolygonSoup soup =
        read("mtllib my room.mtl # here\n" + square +
             "f 1 2 3\nusemtl dark red\nf 1 2 3\nusemtl Material #25\nf 1 2 3\nusemtl dark red  \n"
             "f 1 2 3\n");
    ASSERT_EQ(soup.materials.size(), 2u);
    EXPECT_EQ(soup.materials[0].name, "dark red");
    EXPECT_EQ(soup.materials[1].name, "Material #25");
    EXPECT_EQ(soup.polygons[0].material, -1);
    EXPECT_EQ(soup.polygons[1].material, 0);
    EXPECT_EQ(soup.polygons[2].material, 1);
    EXPECT_EQ(soup.polygons[3].material, 0);
    ASSERT_EQ(soup.material_libraries.size(), 1u);
    EXPECT_EQ(soup.material_libraries[0].name, "my room.mtl");
    EXPECT_EQ(soup.material_libraries[0].place.column, 8);
}

TEST(ObjReader, MayNameVerticesThatFollow) {
    EXPECT_EQ(read("f 1 2 3\n" + square).corners, (std::vector<int>{0, 1, 2}));
}

TEST(ObjReader, PassesOverWhatIsNotSurface) {
    const PolygonSoup soup = read("o a f b\ng x\ns off\nvt 0 0\nvn 0 0 1\n" + square +
                                  "l 1 2\np 1\nf 1 2 3\ncurv 1\ncurv 2\n");
    EXPECT_EQ(soup.polygons.size(), 1u);
    ASSERT_EQ(soup.warnings.size(), 1u);
    EXPECT_EQ(soup.warnings[0].place.line, 13);
    EXPECT_EQ(soup.warnings[0].message, "statement 'curv' is passed over (also at line 14)");
}

TEST(ObjReader, NamesThePlaceOfMalformedNumbers) {
    EXPECT_EQ(error_of("v 0 0 0\nv 1,5 0 0\n"), "a.obj:2:3: '1,5' is not a number");
    EXPECT_EQ(error_of("v 0 0 nan\n"), "a.obj:1:7: 'nan' is not a finite number");
    EXPECT_EQ(error_of("v 0 -inf 0\n"), "a.obj:1:5: '-inf' is not a finite number");
    EXPECT_EQ(error_of("v 1e400 0 0\n"), "a.obj:1:3: '1e400' is too large");
    EXPECT_EQ(error_of("v 1e15 0 0\n"), "a.obj:1:3: coordinate 1e15 is beyond 1e+12");
    EXPECT_EQ(error_of("v 0x10 0 0\n"), "a.obj:1:3: '0x10' is not a number");
    EXPECT_EQ(error_of("v 3.1+e2 0 0\n"), "a.obj:1:3: '3.1+e2' is not a number");
    EXPECT_EQ(error_of("v 1 2\n"), "a.obj:1:6: a coordinate of the vertex is missing");
}

TEST(ObjReader, NamesThePlaceOfIndicesThatNameNoVertex) {
    EXPECT_EQ(error_of(square + "f 1 2 3 9\n"),
              "a.obj:5:9: vertex index '9' is out of range: the file has 4 vertices");
    EXPECT_EQ(error_of(square + "f 1 2 3 -5\n"),
              "a.obj:5:9: vertex index '-5' is out of range: the file has 4 vertices up to here");
    EXPECT_EQ(error_of(square + "f 0 1 2\n"), "a.obj:5:3: vertex index 0: indices count from 1");
    EXPECT_EQ(error_of(square + "f 1 2 3 99999999999999999999\n"),
              "a.obj:5:9: '99999999999999999999' is too large");
    EXPECT_EQ(error_of(square + "f 1 2 x 4\n"), "a.obj:5:7: 'x' is not a whole number");
    EXPECT_EQ(error_of(square + "f 1 2/x 3\n"),
              "a.obj:5:5: '2/x' is not a corner: v, v/vt, v//vn or v/vt/vn is expected");
}

TEST(ObjReader, RefusesFilesWithoutPolygons) {
    const std::string none = "a.obj: no polygons in the file (f statements)";
    EXPECT_EQ(error_of(""), none);
    EXPECT_EQ(error_of(square + "l 1 2 3\n"), none);
    EXPECT_EQ(error_of(square + "p 1 2 3\n"), none);
    EXPECT_EQ(error_of("garbage\n\x01\x02\n"), none);
}

TEST(ObjReader, RefusesWhatIsNoFile) {
    EXPECT_EQ(input_error_of([] { read_obj("/"); }), "/: is a folder, not a file");
    EXPECT_EQ(input_error_of([] { read_obj("/dev/zero"); }),
              "/dev/zero: is a device or pipe, not a file");
    EXPECT_EQ(input_error_of([] { read_obj("/none.obj"); }),
              "/none.obj: cannot be opened: No such file or directory");
}

}  // namespace
}  // namespace lightwell
