#pragma once

#include <vector>

#include <Eigen/Core>

#include "radiance4d/basis/radiance_space.h"
#include "runtime/projection/four_points.h"
#include "runtime/propagation/packed_haar.h"

namespace lightwell {

/// The cells of one element as light projection needs them: where they lie, and how the flux on
/// them becomes coefficients (of a glossy element: see DirectedCells). Coordinates are relative to
/// the element's centre, so that single precision is enough wherever the element stands.
class ElementCells {
  public:
    explicit ElementCells(const Element& element);

    const CellTree& tree() const { return haar_.tree(); }
    const Vec3& centre() const { return centre_; }
    /// Points to the air.
    const Vec3& normal() const { return normal_; }
    /// Longest diagonal of the element [m].
    double extent() const { return extent_; }

    /// Corners of a cell of any level, by CellTree::position.
    const FourPoints& corners(std::uint32_t position) const { return corners_[position]; }

    /// Nodes of Gauss's rule of 2 x 2 points over a finest cell, and their weights, which add up to
    /// the cell's area [m2].
    struct Nodes {
        FourPoints at;
        Eigen::Array4f area;
        float squared_size;  ///< square of the longer diagonal [m2]
    };
    const Nodes& nodes(std::uint32_t finest) const { return nodes_[finest]; }
    /// A finest cell in the world.
    const Quad& cell(std::uint32_t finest) const { return cell_[finest]; }

    /// Turns the flux on the finest cells [lm] into coefficients: the flux, in the columns 0 ..
    /// cells-1 of `flux`, is overwritten; the coefficients go to the columns of `field` from
    /// `first` on. Radiance is the mean over what is open of a cell (WRT eq. 1 and 2).
    void analyse(PackedField& flux, PackedField& field) const;

  private:
    PackedHaar haar_;
    std::uint32_t first_;
    std::uint32_t stride_;  ///< angular functions to each spatial one
    Vec3 centre_, normal_;
    double extent_;
    std::vector<FourPoints> corners_;
    std::vector<Nodes> nodes_;
    std::vector<Quad> cell_;
    std::vector<float> per_flux_;  ///< scaling coefficient of a finest cell per flux on it
};

}  // namespace lightwell
