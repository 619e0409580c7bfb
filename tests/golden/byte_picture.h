#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lightwell::testing {

/// A picture as a display takes it: red, green, blue of every pixel, sRGB-encoded, the top row
/// first.
struct BytePicture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
};

/// @return an empty picture where there is no PNG of that name
BytePicture read_png(const std::string& path);
void write_png(const BytePicture& picture, const std::string& path);

}  // namespace lightwell::testing
