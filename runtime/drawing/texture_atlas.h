#pragma once

#include <vector>

#include "runtime/propagation/packed_field.h"

namespace lightwell {

/// Size of a texture [texels].
struct TextureSize {
    int columns = 1;
    int rows = 1;
};

/// Where a texture lies in the atlas, without its border [texels].
struct AtlasPlace {
    int left = 0;
    int top = 0;
    TextureSize size;
};

/// Many small textures in one image of floating-point texels, each with a border of one texel, so
/// that bilinear filtering inside of one never reads another.
///
/// Packed once, on shelves: textures by descending height, rows of the image filled from the left.
class TextureAtlas {
  public:
    explicit TextureAtlas(const std::vector<TextureSize>& sizes);

    std::size_t textures() const { return places_.size(); }
    const AtlasPlace& place(std::size_t texture) const { return places_[texture]; }
    /// Size of the image [texels].
    const TextureSize& size() const { return size_; }
    /// The image row by row, four floats a texel; the fourth is zero.
    const float* pixels() const { return pixels_.data(); }

    /// A texel, column -1 .. columns and row -1 .. rows: those outside are the border.
    Eigen::Map<Packed> texel(std::size_t texture, int column, int row) {
        return Eigen::Map<Packed>(pixels_.data() + offset(texture, column, row));
    }
    Eigen::Map<const Packed> texel(std::size_t texture, int column, int row) const {
        return Eigen::Map<const Packed>(pixels_.data() + offset(texture, column, row));
    }

    /// The texture at (u,v) in [0,1]^2, between the centres of four texels.
    Packed bilinear(std::size_t texture, double u, double v) const;
    /// The same without the border: towards the rim the outermost texels go on unchanged.
    Packed bilinear_inside(std::size_t texture, double u, double v) const;
    /// The texel that (u,v) falls on.
    Packed nearest(std::size_t texture, double u, double v) const;

  private:
    Packed between(std::size_t texture, double u, double v, int border) const;
    std::size_t offset(std::size_t texture, int column, int row) const {
        const AtlasPlace& place = places_[texture];
        return 4 * (static_cast<std::size_t>(place.top + row) *
                        static_cast<std::size_t>(size_.columns) +
                    static_cast<std::size_t>(place.left + column));
    }

    std::vector<AtlasPlace> places_;
    TextureSize size_;
    std::vector<float> pixels_;
};

}  // namespace lightwell
