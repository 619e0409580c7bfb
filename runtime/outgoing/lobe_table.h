#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "radiance4d/scene/material.h"
#include "radiance4d/scene/quad.h"

namespace lightwell {

/// Incident radiance over directions: one row per angular function, one column per channel.
using AngularLight = Eigen::Array<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// A lobe as the eye sees it: for directions all over the hemisphere, the wavelet coefficients of
/// pi times the lobe over the directions that light comes from. Multiplying incident light by the
/// BRDF is then a scalar product in wavelet space (WRT section 5.3) with few terms: angular
/// sub-trees that the lobe does not reach have none, so they are skipped.
///
/// The towards-side is a grid over the angular square, interpolated bilinearly; uniform light is
/// reflected by the lobe's albedo exactly. BrdfProduct is the slow and plain version.
class LobeTable {
  public:
    /// @param level of the incident light's angular functions, 0 to 5
    LobeTable(const Lobe& lobe, int level);

    /// Radiance that leaves towards a unit direction (normal along z, z > 0) by a lobe of
    /// reflectance 1.
    /// @param incident angular coefficients of incident radiance, see AngularReflection
    Rgb reflected(const Vec3& towards, Eigen::Ref<const AngularLight> incident) const;

  private:
    /// The lobe towards one node of the grid.
    struct Node {
        std::vector<std::uint16_t> function;
        std::vector<float> coefficient;
    };

    double albedo(double cosine) const;

    int cells_;                   ///< along either side of the grid; one more node
    std::vector<Node> nodes_;     ///< of uniform light 1 each makes 1
    std::vector<double> albedo_;  ///< of the lobe, by the square of place / entries
};

}  // namespace lightwell
