#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "radiance4d/basis/radiance_space.h"
#include "runtime/propagation/packed_haar.h"

namespace lightwell {

/// The cells of a glossy element, as light projection needs them: the light on each keeps the
/// direction that it comes from. add_directed_light is the slow and plain version.
class DirectedCells {
  public:
    /// @param element  with angular functions
    explicit DirectedCells(const Element& element);

    /// Takes up the light of one source.
    /// @param from  where it stands [m]
    /// @param flux  on the finest cells [lm], one column each
    void add(const Vec3& from, const PackedField& flux);
    /// Writes the element's coefficients of all that was added since the last call to the columns
    /// of `field`, and begins anew. Nothing is allocated.
    void analyse(PackedField& field);

  private:
    /// Points along either side of a cell at which its direction to the source is looked at.
    static constexpr std::size_t points = 4;
    using Points = std::array<Eigen::Vector3f, points * points>;

    PackedHaar haar_;
    CellTree angle_;
    std::uint32_t first_;
    Vec3 centre_;
    Eigen::Matrix3d frame_;
    std::vector<Points> points_;   ///< by finest cell, from the centre, in the element's frame
    std::vector<float> per_flux_;  ///< angular mean of a finest cell per flux on it
    /// By finest angular cell: the angular functions that its light has a part in, and which.
    std::vector<std::vector<std::pair<std::uint32_t, float>>> parts_;
    std::vector<float> seen_;  ///< scratch: by finest angular cell, of one spatial cell's light
    PackedField light_;        ///< cell by cell for one angular function after another
    PackedField cells_;        ///< scratch: by finest cell
    bool is_dark_ = true;
};

}  // namespace lightwell
