#include "runtime/propagation/packed_haar.h"

namespace lightwell {

PackedHaar::PackedHaar(const HaarBasis& basis) : tree_(basis.tree()) {
    const std::uint32_t first_finest = tree_.positions() - tree_.functions();
    for (std::uint32_t position = 0; position < first_finest; ++position)
        frame_.emplace_back(basis.frame(tree_.at(position)).cast<float>());
}

void PackedHaar::analyse(PackedField& scaling, PackedField& field, std::uint32_t first,
                         std::uint32_t stride) const {
    // The scaling coefficient of a parent takes the place of one that has been read before.
    for (int level = tree_.levels() - 1; level >= 0; --level) {
        const Frame* frame = frame_.data() + tree_.position({level, 0});
        for (std::uint32_t m = 0; m < tree_.cells(level); ++m) {
            const Frame& w = frame[m];
            const std::uint32_t wavelet = first + stride * tree_.wavelet({level, m}, 1);
            if (tree_.children(level) == 4) {
                const Eigen::Index child = Eigen::Index{4} * m;
                const Packed a = scaling.col(child), b = scaling.col(child + 1);
                const Packed c = scaling.col(child + 2), d = scaling.col(child + 3);
                for (std::uint32_t k = 1; k < 4; ++k)
                    field.col(wavelet + (k - 1) * stride) =
                        w(k, 0) * a + w(k, 1) * b + w(k, 2) * c + w(k, 3) * d;
                scaling.col(m) = w(0, 0) * a + w(0, 1) * b + w(0, 2) * c + w(0, 3) * d;
            } else {
                const Eigen::Index child = Eigen::Index{2} * m;
                const Packed a = scaling.col(child), b = scaling.col(child + 1);
                field.col(wavelet) = w(1, 0) * a + w(1, 1) * b;
                scaling.col(m) = w(0, 0) * a + w(0, 1) * b;
            }
        }
    }
    field.col(first) = scaling.col(0);
}

void PackedHaar::synthesise(const PackedField& field, std::uint32_t first, int level,
                            PackedField& scaling, std::uint32_t stride) const {
    scaling.col(0) = field.col(first);
    for (int coarse = 0; coarse < level; ++coarse) {
        const Frame* frame = frame_.data() + tree_.position({coarse, 0});
        // Backwards: children take places that have been read before.
        for (std::uint32_t m = tree_.cells(coarse); m-- > 0;) {
            const Frame& w = frame[m];
            const std::uint32_t wavelet = first + stride * tree_.wavelet({coarse, m}, 1);
            const Packed a = scaling.col(m), b = field.col(wavelet);
            if (tree_.children(coarse) == 4) {
                const Packed c = field.col(wavelet + stride), d = field.col(wavelet + 2 * stride);
                for (std::uint32_t k = 0; k < 4; ++k)
                    scaling.col(Eigen::Index{4} * m + k) =
                        w(0, k) * a + w(1, k) * b + w(2, k) * c + w(3, k) * d;
            } else {
                for (std::uint32_t k = 0; k < 2; ++k)
                    scaling.col(Eigen::Index{2} * m + k) = w(0, k) * a + w(1, k) * b;
            }
        }
    }
}

}  // namespace lightwell
