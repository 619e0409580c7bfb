#include "viewer/images/image.h"

namespace lightwell {

std::size_t blacken_non_finite(Image& image) {
    std::size_t count = 0;
    for (Image::Pixel& pixel : image.pixels()) {
        if (pixel.isFinite().all()) continue;
        pixel = pixel.isFinite().select(pixel, 0.0f);
        ++count;
    }
    return count;
}

}  // namespace lightwell
