#pragma once

#include <vector>

#include <Eigen/Core>

#include "radiance4d/basis/cell_tree.h"
#include "radiance4d/scene/quad.h"

namespace lightwell {

/// Row-major, so that one row is one basis function or cell of the transformed domain.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The orthonormal Haar basis over the cells of one 2D domain.
///
/// The measure of a cell is its area on the quad, so the basis is orthonormal in L2 of the
/// *surface*, whatever the shape of the convex quad. Coefficients of scaling functions are
/// half-densities, s_c = sqrt(A_c) * (mean over c): the cell-wise form of l = sqrt(J) L. The
/// scaling function of a parent is sum_c h_c phi_c with h_c = sqrt(A_c/A_parent), and the wavelets
/// complete h to an orthonormal frame; with equal areas these are the classical non-standard Haar
/// wavelets (WRT eq. 1 and 2, figure 2b). Weighting by area instead of by the bilinear parameters
/// keeps a constant radiance in the span of the coarsest level on trapezoids as well, which energy
/// conservation rests on (cf. unbalanced Haar wavelets, Girardi and Sweldens 1997).
///
/// Where part of a cell is buried (see OpenMask), only its open part is measured: means are then
/// means over what light can reach, and a block's foot does not darken the floor around it.
class HaarBasis {
  public:
    HaarBasis() = default;
    /// The basis on a quad, cells cut along lines of constant u and v.
    /// @param open  open share of each finest cell, in (0,1]; empty: all of every cell
    HaarBasis(const Quad& quad, CellTree tree, const std::vector<double>& open = {});

    const CellTree& tree() const { return tree_; }
    /// Measured area of a cell [m2].
    double area(const Cell& cell) const { return area_[tree_.position(cell)]; }
    /// The same by CellTree::position.
    double area_at(std::uint32_t position) const { return area_[position]; }
    /// The orthonormal frame of a cell that is not finest: row 0 holds h_c, row k the weights of
    /// wavelet k on the children's scaling functions. Only the first children(level) rows and
    /// columns are set.
    const Eigen::Matrix4d& frame(const Cell& cell) const { return frame_[tree_.position(cell)]; }

    /// Scaling coefficients of the cells of level `depth`, one row each, become wavelet
    /// coefficients, in place: row i is basis function i. Exact inverse of synthesise. O(rows) per
    /// column.
    void analyse(Eigen::Ref<RowMatrix> rows, int depth) const;
    /// Wavelet coefficients become scaling coefficients of the cells of level `depth`, in place.
    void synthesise(Eigen::Ref<RowMatrix> rows, int depth) const;

  private:
    CellTree tree_;
    std::vector<double> area_ = {1.0};    // by CellTree::position
    std::vector<Eigen::Matrix4d> frame_;  // by CellTree::position, finest cells left out
};

}  // namespace lightwell
