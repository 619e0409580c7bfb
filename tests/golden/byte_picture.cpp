#include "tests/golden/byte_picture.h"

#include <stdexcept>

#include <png.h>

namespace lightwell::testing {

namespace {

png_image described(const BytePicture& picture) {
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGB;
    return image;
}

}  // namespace

BytePicture read_png(const std::string& path) {
    png_image image = described({});
    if (!png_image_begin_read_from_file(&image, path.c_str())) return {};
    image.format = PNG_FORMAT_RGB;
    BytePicture picture{static_cast<int>(image.width), static_cast<int>(image.height), {}};
    picture.rgb.resize(PNG_IMAGE_SIZE(image));
    if (!png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr)) return {};
    return picture;
}

void write_png(const BytePicture& picture, const std::string& path) {
    png_image image = described(picture);
    if (!png_image_write_to_file(&image, path.c_str(), 0, picture.rgb.data(), 0, nullptr))
        throw std::runtime_error(path + ": " + image.message);
}

}  // namespace lightwell::testing
