#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "radiance4d/failure.h"

namespace lightwell {

/// The scalar types of PLY files.
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Size in a binary file [bytes].
std::size_t size_of(PlyType type);
bool is_whole(PlyType type);

/// A number, or a list of numbers with its length in front, in every row of an element.
struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    bool is_list = false;
    PlyType length_type = PlyType::uint8;  ///< of lists
};

/// A table of `count` rows.
struct PlyElement {
    std::string name;
    std::int64_t count = 0;
    std::vector<PlyProperty> properties;
    Place place;
};

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };

/// What a PLY file says of itself before its numbers start.
struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::size_t body = 0;  ///< first byte after the header
    int body_line = 1;     ///< its line
};

/// Reads the header of a PLY file and checks that the file is long enough for as many rows as it
/// promises, so that memory may be taken for them.
/// @param file for messages
/// @throws InputError with line and column
PlyHeader read_ply_header(std::string_view bytes, const std::string& file);

}  // namespace lightwell
