#pragma once

#include <vector>

#include "radiance4d/basis/haar.h"
#include "runtime/propagation/packed_field.h"

namespace lightwell {

/// The transforms of HaarBasis for packed coefficients, in single precision and in place.
class PackedHaar {
  public:
    explicit PackedHaar(const HaarBasis& basis);

    const CellTree& tree() const { return tree_; }

    /// Scaling coefficients of the finest cells, in the columns 0 .. functions()-1 of `scaling`,
    /// become wavelet coefficients in the columns of `field` from `first` on, every `stride`-th
    /// (the angular means where an element has angular functions). `scaling` is overwritten.
    void analyse(PackedField& scaling, PackedField& field, std::uint32_t first,
                 std::uint32_t stride = 1) const;
    /// The reverse, as far as the cells of a level: wavelets of that level and finer are not read.
    void synthesise(const PackedField& field, std::uint32_t first, int level, PackedField& scaling,
                    std::uint32_t stride = 1) const;

  private:
    using Frame = Eigen::Matrix<float, 4, 4, Eigen::RowMajor>;

    CellTree tree_;
    std::vector<Frame> frame_;  ///< by CellTree::position, as HaarBasis::frame
};

}  // namespace lightwell
