#include <cmath>
#include <cstdint>
#include <vector>

#include <fmt/format.h>
#include <png.h>

#include "radiance4d/atomic_file.h"
#include "viewer/images/image_file.h"
#include "viewer/images/tone.h"

namespace lightwell {

namespace {

std::vector<std::uint8_t> encode_pixels(const Image& image) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * image.pixels().size());
    for (const Image::Pixel& pixel : image.pixels())
        for (int channel = 0; channel < 3; ++channel)
            bytes.push_back(
                static_cast<std::uint8_t>(std::lround(255 * srgb_encoded(pixel[channel]))));
    return bytes;
}

[[noreturn]] void fail(const std::string& path, const png_image& control) {
    throw SystemError(fmt::format("{}: cannot encode PNG: {}", path, control.message));
}

}  // namespace

WriteReport write_png(const Image& image, const std::string& path) {
    Image clean = image;
    WriteReport report;
    report.non_finite_pixels = blacken_non_finite(clean);
    const std::vector<std::uint8_t> pixels = encode_pixels(clean);

    png_image control = {};
    control.version = PNG_IMAGE_VERSION;
    control.width = static_cast<png_uint_32>(image.width());
    control.height = static_cast<png_uint_32>(image.height());
    control.format = PNG_FORMAT_RGB;
    // libpng writes to memory only: a full disk is then one library's business, not three's.
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(control);
    std::string file(size, '\0');
    if (!png_image_write_to_memory(&control, file.data(), &size, 0, pixels.data(), 0, nullptr))
        fail(path, control);
    file.resize(size);
    write_atomically(path, file);
    return report;
}

}  // namespace lightwell
