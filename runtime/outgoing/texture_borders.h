#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "radiance4d/basis/radiance_space.h"
#include "radiance4d/scene/visibility.h"
#include "runtime/drawing/texture_atlas.h"

namespace lightwell {

/// The borders of textures that lie on elements, one each: they hold the light of coplanar
/// neighbours, where there are any, so that no edge shows between quads of one wall; but not of
/// those behind another wall that stands on the edge. Elsewhere a texture is continued linearly,
/// but not beyond nothing or twice its last texel.
class TextureBorders {
  public:
    /// @param goes_on  whether light goes on from one element to another that is coplanar
    TextureBorders(const RadianceSpace& space, const TextureAtlas& atlas,
                   const std::function<bool(std::size_t, std::size_t)>& goes_on);

    /// Whose light the border of an element holds.
    const std::vector<std::size_t>& neighbours(std::size_t element) const {
        return bordered_[element].neighbours;
    }
    /// Once the textures of the element and its neighbours are filled. Nothing is allocated.
    void fill(std::size_t element, TextureAtlas& atlas) const;

  private:
    struct Texel {
        int column, row;
        /// The element that it lies on, and where; its own if there is none there.
        std::size_t neighbour;
        double u, v;
        /// Else the two texels that it continues: this many columns and rows on, and as many again.
        int to_column, to_row;
    };
    struct Bordered {
        std::vector<Texel> texels;
        std::vector<std::size_t> neighbours;
    };

    static Bordered border_of(const RadianceSpace& space, const TextureSize& size,
                              std::size_t element, const std::vector<std::size_t>& candidates,
                              const Visibility& visibility);

    std::vector<Bordered> bordered_;  ///< by element
};

}  // namespace lightwell
