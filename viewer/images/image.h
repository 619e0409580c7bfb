#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "radiance4d/failure.h"

namespace lightwell {

/// A picture in linear Rec. 709 RGB, row by row, the top row first, each row from left to right.
/// What the numbers measure (cd/m2, lx, or the light of a display in [0,1]) is for its owner to
/// say.
class Image {
  public:
    using Pixel = Eigen::Array3f;

    Image() = default;
    /// All black. Both lengths are at least 1.
    Image(int width, int height)
        : width_(width),
          height_(height),
          pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                  Pixel::Zero()) {
        LIGHTWELL_CHECK_OP(width, >, 0);
        LIGHTWELL_CHECK_OP(height, >, 0);
    }

    int width() const { return width_; }
    int height() const { return height_; }
    /// The pixel in column x from the left and row y from the top.
    Pixel& at(int x, int y) { return pixels_[index(x, y)]; }
    const Pixel& at(int x, int y) const { return pixels_[index(x, y)]; }
    std::vector<Pixel>& pixels() { return pixels_; }
    const std::vector<Pixel>& pixels() const { return pixels_; }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }

    int width_ = 0;
    int height_ = 0;
    std::vector<Pixel> pixels_;
};

/// Luminance of a linear Rec. 709 pixel, in the pixel's own unit.
inline float luminance(const Image::Pixel& pixel) {
    return 0.2126f * pixel[0] + 0.7152f * pixel[1] + 0.0722f * pixel[2];
}

/// Sets every component that is NaN or infinite to zero.
///
/// A file must not carry them: viewers show them each in their own way, and one of them spoils
/// every average over the picture. The picture is still worth keeping, so they are counted, not
/// refused.
/// @return how many pixels had such a component.
std::size_t blacken_non_finite(Image& image);

}  // namespace lightwell
