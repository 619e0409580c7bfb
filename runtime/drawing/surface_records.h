#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "runtime/drawing/texture_atlas.h"

namespace lightwell {

/// Four floats: what a shader reads from a texture buffer at once.
using Record = std::array<float, 4>;

/// The length and the place by which a scene's coordinates are brought near [-1/2,1/2]^3, so that
/// floats serve alike at any scale and place.
struct SceneScale {
    Vec3 centre = Vec3::Zero();
    double extent = 1;  ///< the diagonal of the scene's box [m]

    explicit SceneScale(const Scene& scene);
    Vec3 scaled(const Vec3& point) const { return (point - centre) / extent; }
};

/// Records a quad takes: its four vertices (scaled; the fourth number of the first two is the
/// element on the front and on the back, or -1), its normal, then for front and back the
/// reflectance over pi and the emission [cd/m2] that leaves that side.
constexpr int records_per_quad = 9;
/// Records an element takes: its place in the atlas (left, top, columns, rows) and its cells
/// (columns, rows, levels over the deepest, coefficients by a logarithmic measure in [0,1]).
constexpr int records_per_element = 2;

/// What shaders must know of the surfaces: all quads' records, then all elements'.
struct SurfaceRecords {
    std::vector<Record> records;
    int first_element = 0;                ///< index of the first element's first record
    std::uint64_t most_coefficients = 0;  ///< of the operator, on one element
    int deepest_level = 0;

    SurfaceRecords(const GlobalTransport& transport, const SceneScale& scale);
    /// Enters where the textures lie. @return whether that is news.
    bool place(const TextureAtlas& atlas);
};

}  // namespace lightwell
