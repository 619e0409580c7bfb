#pragma once

#include <Eigen/Core>

#include "radiance4d/basis/cell_tree.h"
#include "radiance4d/scene/quad.h"

namespace lightwell {

/// A continuous function over a quad with given means over its finest cells: what a picture shows
/// instead of blocks.
///
/// Piecewise parabolic reconstruction (Colella and Woodward 1984) along u and then v: fourth-order
/// values at the interfaces between cells from the means of four, kept between the two neighbours'
/// means; at the rim one-sided, kept within one step of
/// extrapolation. In each cell the biquadratic with these edge values and the cell's mean. Means
/// over (u,v) are preserved wherever the function is not clamped to be >= 0.
class SmoothSurface {
  public:
    /// @param tree   the cells of the domain
    /// @param means  one row per finest cell in cell order, one column per channel; any unit
    SmoothSurface(const CellTree& tree, const Eigen::Array<double, Eigen::Dynamic, 3>& means);

    /// Value at (u,v) in [0,1]^2, in the unit of the means, never negative.
    Rgb at(double u, double v) const;

  private:
    Rgb node(Eigen::Index column, Eigen::Index row) const {
        return nodes_.row(row * stride_ + column).transpose();
    }

    Eigen::Index columns_;
    Eigen::Index rows_;
    Eigen::Index stride_;
    /// Node (2i+1, 2j+1) is the mean of cell (i,j); an even index is an interface. So each cell has
    /// 3 x 3 nodes: values at corners, means along edges, and its own mean.
    Eigen::Array<double, Eigen::Dynamic, 3> nodes_;
};

}  // namespace lightwell
