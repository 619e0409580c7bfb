#include "viewer/window/window_picture.h"

#include <cmath>
#include <vector>

#include <GL/glcorearb.h>

#include "viewer/images/image_file.h"

namespace lightwell {

namespace {

/// Inverse of srgb_encoded.
float linear(unsigned char byte) {
    const double encoded = byte / 255.0;
    return static_cast<float>(encoded <= 0.04045 ? encoded / 12.92
                                                 : std::pow((encoded + 0.055) / 1.055, 2.4));
}

}  // namespace

void write_window_picture(const GlFunctions& gl, int width, int height, const std::string& path) {
    std::vector<unsigned char> rgba(4 * static_cast<std::size_t>(width) *
                                    static_cast<std::size_t>(height));
    gl.bind_framebuffer(GL_FRAMEBUFFER, 0);
    gl.read_buffer(GL_BACK);
    gl.pixel_storei(GL_PACK_ALIGNMENT, 4);
    gl.read_pixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::size_t at =
                4 * (static_cast<std::size_t>(height - 1 - y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x));
            image.at(x, y) =
                Image::Pixel(linear(rgba[at]), linear(rgba[at + 1]), linear(rgba[at + 2]));
        }
    // Bytes are finite.
    static_cast<void>(write_png(image, path));
}

}  // namespace lightwell
