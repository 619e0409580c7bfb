#include "solver/reading/ply_reader.h"

#include <cstring>

#include <gtest/gtest.h>

#include "tests/scratch_folder.h"
#include "tests/unit/reading/files.h"

namespace lightwell {
namespace {

using testing::input_error_of;
using testing::ScratchFolder;

const std::string square_header =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string square_rows = "0.5 0 0\n1 0 0\n1 1 0\n0 1 0\n";

PolygonSoup read(const std::string& bytes) {
    const ScratchFolder folder;
    return read_ply(folder.write("a.ply", bytes));
}

std::string error_of(const std::string& bytes) {
    return input_error_of([&] { read(bytes); });
}

std::string ascii(const std::string& rows) {
    return "ply\nformat ascii 1.0\n" + square_header + rows;
}

/// The bytes of a number in the order that a file says.
template <typename Number>
std::string bytes_of(Number number, bool big_endian) {
    std::string bytes(sizeof(Number), '\0');
    std::memcpy(bytes.data(), &number, sizeof(Number));
    return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

TEST(PlyReader, ReadsText) {
    const PolygonSoup soup = read(ascii(square_rows + "4 0 1 2 3\n"));
    ASSERT_EQ(soup.vertices.size(), 4u);
    EXPECT_EQ(soup.vertices[0], Vec3(0.5, 0, 0));
    EXPECT_EQ(soup.corners, (std::vector<int>{0, 1, 2, 3}));
    EXPECT_EQ(soup.polygons[0].line, 14);
    EXPECT_EQ(soup.polygons[0].material, -1);
}

TEST(PlyReader, ReadsBothByteOrdersAndEveryType) {
    for (const bool big : {false, true}) {
        std::string file = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                           "_endian 1.0\ncomment element fake 3\n"
                           "element vertex 3\nproperty uchar red\nproperty double z\n"
                           "property list ushort float weights\nproperty short x\n"
                           "property int32 y\n"
                           "element edge 2\nproperty list int8 uint16 ends\nproperty double w\n"
                           "element face 2\nproperty uint flags\n"
                           "property list uint uint8 vertex_index\nend_header\n";
        const double z[] = {-1e-3, 2.25, 1e10};
        for (int i = 0; i < 3; ++i) {
            file += bytes_of(std::uint8_t(200), big) + bytes_of(z[i], big);
            file += bytes_of(std::uint16_t(i), big);
            for (int j = 0; j < i; ++j)
                file += bytes_of(0.5f, big);
            file += bytes_of(std::int16_t(-300 + i), big) + bytes_of(std::int32_t(70000 * i), big);
        }
        for (int i = 0; i < 2; ++i)
            file += bytes_of(std::int8_t(1), big) + bytes_of(std::uint16_t(7), big) +
                    bytes_of(1.5, big);
        for (int i = 0; i < 2; ++i) {
            file += bytes_of(std::uint32_t(9), big) + bytes_of(std::uint32_t(3), big);
            file += std::string("\0\1\2", 3);
        }
        const PolygonSoup soup = read(file);
        ASSERT_EQ(soup.vertices.size(), 3u);
        EXPECT_EQ(soup.vertices[0], Vec3(-300, 0, -1e-3));
        EXPECT_EQ(soup.vertices[2], Vec3(-298, 140000, 1e10));
        EXPECT_EQ(soup.corners, (std::vector<int>{0, 1, 2, 0, 1, 2}));
        EXPECT_TRUE(soup.warnings.empty());
        EXPECT_EQ(read(file + "\n").warnings.size(), 1u);
        const std::string early = error_of(file.substr(0, file.size() - 1));
        EXPECT_NE(early.find("row 2 of 2 'face': the file ends too early"), std::string::npos)
            << early;
    }
}

TEST(PlyReader, KnowsWhereABinaryBodyStarts) {
    // The first byte of the body is that of a line feed.
    const std::string line =
        "element vertex 3;property uchar x;property uchar y;property uchar z;"
        "element face 1;property list uchar uchar vertex_indices;end_header;";
    const std::string body = "\n\r\n\r\n\r1\n\r" + std::string("\3\0\1\2", 4);
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        std::string header = "ply;format binary_little_endian 1.0;" + line;
        for (std::size_t at = 0; (at = header.find(';', at)) != std::string::npos;)
            header.replace(at, 1, end);
        EXPECT_EQ(read(header + body).vertices[2], Vec3('1', '\n', '\r'));
    }
    // Some writers end only the last line of the header in CR LF.
    const std::string mixed =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\n"
        "property uchar x\nproperty uchar y\nproperty uchar z\n"
        "element face 1\nproperty list uchar uchar vertex_indices\n"
        "end_header\r\n";
    EXPECT_EQ(read(mixed + body).vertices[2], Vec3('1', '\n', '\r'));
}

TEST(PlyReader, ChecksCountsBeforeItTakesMemory) {
    const auto with_count = [](const std::string& count) {
        return "ply\nformat ascii 1.0\nelement vertex " + count +
               "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
    };
    EXPECT_EQ(error_of(with_count("4000000000")),
              "a.ply:3:1: 4000000000 rows of 'vertex' cannot be in a file of 109 bytes");
    EXPECT_EQ(error_of(with_count("9223372036854775807")).substr(0, 10), "a.ply:3:1:");
    EXPECT_EQ(error_of(with_count("9223372036854775808")),
              "a.ply:3:16: '9223372036854775808' is too large");
    EXPECT_EQ(error_of(with_count("-4")), "a.ply:3:16: -4 rows of vertex");
    EXPECT_EQ(error_of(with_count("foo")), "a.ply:3:16: 'foo' is not a whole number");
    EXPECT_EQ(error_of("ply\nformat ascii 1.0\nelement a 9\nend_header\n\n"),
              "a.ply:3:1: element 'a' has rows but no properties");
    EXPECT_EQ(error_of(ascii(square_rows + "4000000000 0 1 2\n")),
              "a.ply:14:17: a number of the row is missing");
}

TEST(PlyReader, RefusesDamagedHeaders) {
    EXPECT_EQ(error_of(""), "a.ply:1:1: not a PLY file: it must start with ply");
    EXPECT_EQ(error_of("ply\n"), "a.ply:2:1: the PLY header does not end (end_header is missing)");
    EXPECT_EQ(error_of("ply\nformat ascii 2.0\n"),
              "a.ply:2:14: PLY version must be 1.0, not '2.0'");
    EXPECT_EQ(error_of("ply\nformat text 1.0\n"),
              "a.ply:2:8: 'text' is no PLY format (ascii, binary_little_endian, "
              "binary_big_endian)");
    EXPECT_EQ(error_of("ply\nend_header\n"), "a.ply:2:1: the PLY header has no format statement");
    EXPECT_EQ(error_of("ply\nproperty float x\n"), "a.ply:2:1: property before the first element");
    EXPECT_EQ(error_of("ply\nelement a 1\nproperty half x\n"), "a.ply:3:10: 'half' is no PLY type");
    EXPECT_EQ(error_of("ply\nelement a 1\nproperty list float int x\n"),
              "a.ply:3:15: the length of a list must be a whole number");
    EXPECT_EQ(error_of("ply\nelement a 1\nelement a 1\n"), "a.ply:3:1: a second element 'a'");
    EXPECT_EQ(error_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                       "property float y\nend_header\n0 0\n"),
              "a.ply:3:1: vertices have no property z");
}

TEST(PlyReader, RefusesDamagedRows) {
    EXPECT_EQ(error_of(ascii(square_rows + "4 0 1 2 9\n")),
              "a.ply:14:9: vertex index 9 is out of range: the file has 4 vertices");
    EXPECT_EQ(error_of(ascii(square_rows + "4 0 1 2 -1\n")),
              "a.ply:14:9: vertex index -1 is out of range: the file has 4 vertices");
    EXPECT_EQ(error_of(ascii(square_rows + "-4 0 1 2 3\n")), "a.ply:14:1: a list of -4 entries");
    EXPECT_EQ(error_of(ascii(square_rows + "3 0 1 2 3\n")),
              "a.ply:14:9: '3' is more than the row needs");
    EXPECT_EQ(error_of(ascii("nan 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n")),
              "a.ply:10:1: 'nan' is not a finite number");
    EXPECT_EQ(error_of(ascii("0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n")),
              "a.ply:10:4: a number of the row is missing");
}

TEST(PlyReader, RefusesFilesWithoutPolygons) {
    EXPECT_EQ(error_of("ply\nformat ascii 1.0\nend_header\n"),
              "a.ply: no polygons in the file (element face)");
}

}  // namespace
}  // namespace lightwell
