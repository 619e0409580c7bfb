#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "runtime/drawing/texture_atlas.h"
#include "runtime/outgoing/lobe_table.h"
#include "runtime/outgoing/texture_borders.h"
#include "runtime/propagation/packed_haar.h"

namespace lightwell {

/// Textures of what the lobes of glossy elements send towards one eye [cd/m2], one texel per finest
/// spatial cell: the product of incident light with the BRDF in wavelet space (WRT section 5.3).
/// Space is traversed first, once per light, then for every texel the angular functions that the
/// lobe reaches from the eye (LobeTable). Elements turned away from the eye cost nothing, nor do
/// those that no light falls on. Borders hold what coplanar neighbours of the same material send.
///
/// Elements without directions have a single dark texel.
class LobeSynthesis {
  public:
    explicit LobeSynthesis(const GlobalTransport& transport);

    /// Whether any element is glossy. If not, the rest does nothing.
    bool is_needed() const { return !lobed_.empty(); }
    /// Takes up the incident light of elements whose coefficients have changed since the last call.
    void take(const PackedField& incident);
    /// Brings the textures of the elements that face the eye up to date: those whose light has
    /// changed, and all if the eye has moved.
    /// @return how many that were
    std::size_t synthesise(const Vec3& eye);

    /// One texture per element of the space.
    const TextureAtlas& atlas() const { return atlas_; }

  private:
    struct LobedElement {
        std::size_t element;
        std::size_t table;
        Rgb reflectance;  ///< of the lobe
        PackedHaar haar;
        std::uint32_t first, angles;
        Vec3 normal, corner;
        Eigen::Matrix3d frame;
        std::vector<Vec3> centre;                ///< by finest cell
        std::vector<float> to_radiance;          ///< by finest cell: 1 / sqrt(area)
        std::vector<std::pair<int, int>> texel;  ///< column and row, by finest cell
        std::vector<char> is_open;               ///< by finest cell
        std::vector<std::uint32_t> stand_in;     ///< by finest cell: the open one shown there
        AngularLight incident;                   ///< angular coefficients, cell by cell
        PackedField scaling;                     ///< scratch: by finest cell
        bool is_dark = true;                     ///< no light is incident
        bool has_changed = false;                ///< the texture is of other light
    };

    static std::vector<TextureSize> sizes(const RadianceSpace& space);
    static LobedElement lobed(const Scene& scene, const RadianceSpace& space, std::size_t element,
                              std::size_t table);
    void take_element(LobedElement& lobed, const PackedField& incident) const;
    void fill_texture(const LobedElement& lobed, const Vec3& eye);

    std::vector<LobeTable> tables_;
    std::vector<LobedElement> lobed_;
    TextureAtlas atlas_;
    TextureBorders borders_;
    std::vector<char> changed_;  ///< scratch: by element, in this call
    PackedField taken_;          ///< the light that the textures are made of
    std::optional<Vec3> eye_;    ///< that they are made for
};

}  // namespace lightwell
