#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiance4d/operator/radiance_field.h"
#include "radiance4d/scene/scene.h"

namespace lightwell {

/// Outgoing radiance: incident light in the basis times the BRDF, towards one direction (WRT
/// section 5.3). Light comes from the basis, cell by cell of space and direction; the BRDF is
/// evaluated at the direction that is looked along, so that highlights are as sharp on the side of
/// the eye as the material makes them.
class BrdfProduct {
  public:
    /// Keeps references to scene and space. Only the light on elements with angular functions is
    /// unfolded into cells; on others the mean alone counts.
    BrdfProduct(const Scene& scene, const RadianceSpace& space, const RadianceField& incident);

    /// Radiance [cd/m2] that leaves a finest spatial cell of an element towards a unit direction in
    /// space; zero below the surface.
    Rgb radiance(std::size_t element, std::uint32_t cell, const Vec3& direction) const;
    /// The same for the cell around a point (u,v) of the element.
    Rgb radiance(std::size_t element, const Vec2& uv, const Vec3& direction) const;

  private:
    const Scene& scene_;
    const RadianceSpace& space_;
    std::vector<Rgb> mean_albedo_;  ///< by material
    /// By element and channel: mean incident radiance over finest spatial cell (row) and finest
    /// angular cell (column).
    std::vector<std::array<RowMatrix, 3>> incident_;
    std::vector<Eigen::Matrix3d> frame_;  ///< by element
};

}  // namespace lightwell
