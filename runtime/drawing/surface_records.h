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
/// reflectance over pi and the emission [cd/m2] that leaves that side, then the reflectance of its
/// lobe and what shapes it: the exponent of Phong's lobe, or less than zero the roughness of GGX.
/// The lobe of a side without directions is part of its reflectance.
constexpr int records_per_quad = 10;
/// Records an element takes: its place in the atlas (left, top, columns, rows), its cells (columns,
/// rows, levels over the deepest, coefficients by a logarithmic measure in [0,1]), and its place in
/// the atlas of lobes (no columns: it has none).
constexpr int records_per_element = 3;

/// What shaders must know of the surfaces: all quads' records, then all elements'.
struct SurfaceRecords {
    std::vector<Record> records;
    int first_element = 0;                ///< index of the first element's first record
    std::uint64_t most_coefficients = 0;  ///< of the operator, on one element
    int deepest_level = 0;

    SurfaceRecords(const GlobalTransport& transport, const SceneScale& scale);
    /// Enters where the textures lie. @return whether that is news.
    bool place(const TextureAtlas& atlas);
    /// The same of the textures of lobes.
    bool place_lobes(const TextureAtlas& atlas);
    /// Whether any element has one.
    bool has_lobes() const;

  private:
    bool enter(const TextureAtlas& atlas, std::size_t e, int which);

    std::vector<char> has_lobe_;  ///< by element
};

}  // namespace lightwell
