#include "viewer/offscreen/render.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace lightwell {

namespace {

/// A tile as drawn, and what its samples are worth.
class Tile {
  public:
    Tile(const SurfaceBuffer& surface, const Vec3& eye, const Shade& shade)
        : surface_(surface), eye_(eye), shade_(shade) {}

    /// The mean over samples x samples from (x,y) on.
    Image::Pixel mean(int x, int y, int samples) const {
        Rgb sum = Rgb::Zero();
        for (int row = 0; row < samples; ++row)
            for (int column = 0; column < samples; ++column)
                sum += sample(x + column, y + row);
        return (sum / (samples * samples)).cast<float>();
    }

  private:
    Rgb sample(int x, int y) const {
        const std::size_t at = surface_.index(x, y);
        if (surface_.quad[at] < 0) return Rgb::Zero();
        const Vec3& position = surface_.position[at];
        return shade_(surface_.quad[at], surface_.front[at] != 0, position,
                      (eye_ - position).normalized());
    }

    const SurfaceBuffer& surface_;
    const Vec3& eye_;
    const Shade& shade_;
};

}  // namespace

Image render(const SurfaceDrawing& drawing, const Camera& camera, const PictureSize& size,
             const Shade& shade) {
    LIGHTWELL_CHECK_OP(size.samples, >=, 1);
    Image image(size.width, size.height);
    const int samples = size.samples;
    const CameraRays rays(camera, samples * size.width, samples * size.height);
    // Whole pixels in every tile.
    const int step = std::max(1, std::min(size.tile, drawing.longest_side()) / samples);

    for (int top = 0; top < size.height; top += step)
        for (int left = 0; left < size.width; left += step) {
            const int width = std::min(step, size.width - left);
            const int height = std::min(step, size.height - top);
            const SurfaceBuffer surface = drawing.draw(
                rays, {samples * left, samples * top, samples * width, samples * height});
            const Tile tile(surface, rays.position(), shade);
            tbb::parallel_for(tbb::blocked_range<int>(0, height),
                              [&](const tbb::blocked_range<int>& rows) {
                                  for (int y = rows.begin(); y < rows.end(); ++y)
                                      for (int x = 0; x < width; ++x)
                                          image.at(left + x, top + y) =
                                              tile.mean(samples * x, samples * y, samples);
                              });
        }
    return image;
}

}  // namespace lightwell
