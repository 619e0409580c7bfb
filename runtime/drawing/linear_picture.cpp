#include "runtime/drawing/linear_picture.h"

#include "runtime/drawing/canvas.h"

namespace lightwell {

LinearPicture mean_of_samples(const Canvas& canvas, int samples, int width, int height) {
    const std::vector<float> drawn = canvas.light();
    LinearPicture picture{width, height, {}};
    picture.rgb.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int channel = 0; channel < 3; ++channel) {
                float sum = 0;
                for (int k = 0; k < samples * samples; ++k) {
                    const int row = samples * (height - 1 - y) + k / samples;
                    const int column = samples * x + k % samples;
                    sum += drawn[4 * (static_cast<std::size_t>(row) *
                                          static_cast<std::size_t>(canvas.width()) +
                                      static_cast<std::size_t>(column)) +
                                 static_cast<std::size_t>(channel)];
                }
                picture.rgb.push_back(sum / static_cast<float>(samples * samples));
            }
    return picture;
}

}  // namespace lightwell
