#pragma once

#include <vector>

namespace lightwell {

class Canvas;

/// A linear picture, row by row, the top row first.
struct LinearPicture {
    int width = 0;
    int height = 0;
    std::vector<float> rgb;  ///< 3 floats a pixel
};

/// Means over the samples of a canvas, `samples` by `samples` of them a pixel.
LinearPicture mean_of_samples(const Canvas& canvas, int samples, int width, int height);

}  // namespace lightwell
