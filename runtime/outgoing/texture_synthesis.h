#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "runtime/drawing/texture_atlas.h"
#include "runtime/outgoing/texture_borders.h"
#include "runtime/propagation/packed_haar.h"

namespace lightwell {

/// Textures of irradiance [lx] on all elements, one each, from the coefficients of a field (WRT
/// section 5.3). What leaves a diffuse surface is reflectance / pi times that, one factor for all
/// of a quad, and left to whoever draws.
///
/// A texture is as fine as the finest coefficient that the operator can give to its element. Its
/// border holds the light of the coplanar neighbours, where there are any, so that no edge shows
/// between quads of one wall; elsewhere the texture is continued linearly. Buried cells
/// carry on for two cells the light of the open ones round about; further in it is dark.
class TextureSynthesis {
  public:
    explicit TextureSynthesis(const GlobalTransport& transport);

    /// Brings the textures up to date with a field, those of elements whose coefficients have
    /// changed since the last call. Nothing is allocated.
    /// @return the number of elements synthesised
    std::size_t synthesise(const PackedField& field);

    /// One texture per element.
    const TextureAtlas& atlas() const { return atlas_; }
    /// Level of the tree whose cells are an element's texels.
    int level(std::size_t element) const { return elements_[element].level; }

  private:
    /// A buried texel and the open ones, or those filled before it, whose mean it takes; dark if
    /// there are none.
    struct BuriedTexel {
        std::uint32_t cell;
        std::vector<std::uint32_t> from;
    };
    struct TexturedElement {
        PackedHaar haar;
        std::uint32_t first, functions;  ///< of its coefficients
        std::uint32_t angles;            ///< angular functions to each spatial one
        int level;
        std::vector<float> to_lux;               ///< by cell of the level
        std::vector<std::pair<int, int>> texel;  ///< column and row, by cell of the level
        std::vector<BuriedTexel> buried;
        PackedField scaling;  ///< scratch: by cell of the level
    };

    static std::vector<TexturedElement> textured(const GlobalTransport& transport);
    static std::vector<TextureSize> sizes(const std::vector<TexturedElement>& elements);
    void fill_texture(std::size_t element, const PackedField& field);

    std::vector<TexturedElement> elements_;
    TextureAtlas atlas_;
    TextureBorders borders_;
    PackedField shown_;          ///< the field that the textures hold
    std::vector<char> changed_;  ///< by element, in this call
};

}  // namespace lightwell
