#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/operator/radiance_field.h"
#include "radiance4d/scene/scene.h"
#include "runtime/outgoing/lobe_table.h"

namespace lightwell {

/// Radiance that leaves glossy elements, from incident light in the basis: the product with the
/// BRDF in wavelet space, lobes tabulated (see LobeTable), interpolated between spatial cells.
class GlossyProduct {
  public:
    /// Keeps references to scene and space.
    GlossyProduct(const Scene& scene, const RadianceSpace& space, const RadianceField& incident);

    /// Whether the element has directions.
    bool is_glossy(std::size_t element) const { return lobe_[element] >= 0; }
    /// Radiance [cd/m2] that leaves a glossy element at (u,v) towards a unit direction in space;
    /// zero below the surface.
    Rgb radiance(std::size_t element, const Vec2& uv, const Vec3& direction) const;
    /// The lobe's part of it.
    Rgb from_lobe(std::size_t element, const Vec2& uv, const Vec3& direction) const;

  private:
    /// The parts by diffuse reflection and by the lobe.
    struct Parts {
        Rgb diffuse = Rgb::Zero();
        Rgb lobe = Rgb::Zero();
    };
    Parts of_cell(std::size_t element, std::uint32_t cell, const Vec3& towards) const;
    Parts between_cells(std::size_t element, const Vec2& uv, const Vec3& direction) const;

    const Scene& scene_;
    const RadianceSpace& space_;
    std::vector<LobeTable> tables_;
    std::vector<int> lobe_;               ///< by element: index into tables_, -1 where diffuse
    std::vector<AngularLight> incident_;  ///< by element: angular coefficients, cell by cell
    std::vector<Eigen::Matrix3d> frame_;  ///< by element
};

}  // namespace lightwell
