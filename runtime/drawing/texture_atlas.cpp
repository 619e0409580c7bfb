#include "runtime/drawing/texture_atlas.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lightwell {

namespace {

/// A width for an image of about square shape that holds the widest texture.
int width_for(const std::vector<TextureSize>& sizes) {
    double area = 0;
    int widest = 1;
    for (const TextureSize& size : sizes) {
        area += static_cast<double>(size.columns + 2) * (size.rows + 2);
        widest = std::max(widest, size.columns + 2);
    }
    return std::max(widest, static_cast<int>(std::ceil(std::sqrt(1.1 * area))));
}

}  // namespace

TextureAtlas::TextureAtlas(const std::vector<TextureSize>& sizes) : places_(sizes.size()) {
    std::vector<std::size_t> order(sizes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return sizes[a].rows > sizes[b].rows; });
    size_.columns = width_for(sizes);
    int left = 0, top = 0, shelf = 0;
    for (const std::size_t texture : order) {
        const TextureSize& size = sizes[texture];
        if (left + size.columns + 2 > size_.columns) {
            top += shelf;
            left = shelf = 0;
        }
        places_[texture] = {left + 1, top + 1, size};
        left += size.columns + 2;
        shelf = std::max(shelf, size.rows + 2);
    }
    size_.rows = std::max(1, top + shelf);
    pixels_.assign(
        4 * static_cast<std::size_t>(size_.columns) * static_cast<std::size_t>(size_.rows), 0);
}

Packed TextureAtlas::bilinear(std::size_t texture, double u, double v) const {
    return between(texture, u, v, 1);
}

Packed TextureAtlas::bilinear_inside(std::size_t texture, double u, double v) const {
    return between(texture, u, v, 0);
}

Packed TextureAtlas::between(std::size_t texture, double u, double v, int border) const {
    const TextureSize& size = places_[texture].size;
    const double x = std::clamp(u * size.columns - 0.5, -1.0 * border, size.columns - 1.0 + border);
    const double y = std::clamp(v * size.rows - 0.5, -1.0 * border, size.rows - 1.0 + border);
    const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
    const int right = std::min(left + 1, size.columns - 1 + border);
    const int bottom = std::min(top + 1, size.rows - 1 + border);
    const auto across = static_cast<float>(x - left), down = static_cast<float>(y - top);
    const Packed low =
        (1 - across) * texel(texture, left, top) + across * texel(texture, right, top);
    const Packed high =
        (1 - across) * texel(texture, left, bottom) + across * texel(texture, right, bottom);
    return (1 - down) * low + down * high;
}

Packed TextureAtlas::nearest(std::size_t texture, double u, double v) const {
    const TextureSize& size = places_[texture].size;
    return texel(texture, std::clamp(static_cast<int>(u * size.columns), 0, size.columns - 1),
                 std::clamp(static_cast<int>(v * size.rows), 0, size.rows - 1));
}

}  // namespace lightwell
