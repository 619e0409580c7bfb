#include "radiance4d/basis/haar.h"

#include <cmath>
#include <utility>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

/// Completes the unit vector h of two or four positive weights to an orthonormal frame that is the
/// Haar frame when the weights are equal: the pairs along u are (0,1) and (2,3).
Eigen::Matrix4d frame_of(const Eigen::Vector4d& h, std::uint32_t children) {
    Eigen::Matrix4d frame = Eigen::Matrix4d::Identity();
    if (children == 2) {
        frame.topLeftCorner<2, 2>() << h[0], h[1], h[1], -h[0];
        return frame;
    }
    const double low = std::hypot(h[0], h[1]), high = std::hypot(h[2], h[3]);
    const Eigen::Vector4d in_low(h[1] / low, -h[0] / low, 0, 0);
    const Eigen::Vector4d in_high(0, 0, h[3] / high, -h[2] / high);
    frame.row(0) = h;
    frame.row(1) = (in_low + in_high) * M_SQRT1_2;
    frame.row(2) << h[0] * high / low, h[1] * high / low, -h[2] * low / high, -h[3] * low / high;
    frame.row(3) = (in_low - in_high) * M_SQRT1_2;
    return frame;
}

}  // namespace

HaarBasis::HaarBasis(const Quad& quad, CellTree tree, const std::vector<double>& open)
    : tree_(std::move(tree)) {
    area_.resize(tree_.positions());
    const std::uint32_t first_finest = tree_.positions() - tree_.functions();
    for (std::uint32_t position = first_finest; position < tree_.positions(); ++position) {
        const ParameterRect r = tree_.rect(tree_.at(position));
        area_[position] = quad.part(r.u0, r.u1, r.v0, r.v1).area() *
                          (open.empty() ? 1 : open[position - first_finest]);
    }
    for (std::uint32_t position = first_finest; position-- > 0;) {
        const Cell cell = tree_.at(position);
        area_[position] = 0;
        for (std::uint32_t c = 0; c < tree_.children(cell.level); ++c)
            area_[position] += area(tree_.child(cell, c));
    }
    frame_.resize(first_finest);
    for (std::uint32_t position = 0; position < first_finest; ++position) {
        const Cell cell = tree_.at(position);
        const std::uint32_t children = tree_.children(cell.level);
        Eigen::Vector4d h = Eigen::Vector4d::Zero();
        for (std::uint32_t c = 0; c < children; ++c)
            h[c] = std::sqrt(area(tree_.child(cell, c)));
        frame_[position] = frame_of(h.normalized(), children);
    }
}

// Both transforms go through a copy of one level: scaling coefficients occupy rows 0 .. cells(l)-1
// in cell order, the wavelets of level l rows cells(l) .. cells(l+1)-1, which is where they stay.
void HaarBasis::analyse(Eigen::Ref<RowMatrix> rows, int depth) const {
    LIGHTWELL_CHECK_OP(rows.rows(), ==, static_cast<Eigen::Index>(tree_.cells(depth)));
    for (int level = depth - 1; level >= 0; --level) {
        const std::uint32_t children = tree_.children(level);
        const RowMatrix finer = rows.topRows(tree_.cells(level + 1));
        for (std::uint32_t m = 0; m < tree_.cells(level); ++m) {
            const Cell cell{level, m};
            const Eigen::Matrix4d& weights = frame(cell);
            for (std::uint32_t k = 0; k < children; ++k) {
                auto target = rows.row(k == 0 ? m : tree_.wavelet(cell, k));
                target = weights(k, 0) * finer.row(children * m);
                for (std::uint32_t c = 1; c < children; ++c)
                    target += weights(k, c) * finer.row(children * m + c);
            }
        }
    }
}

void HaarBasis::synthesise(Eigen::Ref<RowMatrix> rows, int depth) const {
    LIGHTWELL_CHECK_OP(rows.rows(), ==, static_cast<Eigen::Index>(tree_.cells(depth)));
    for (int level = 0; level < depth; ++level) {
        const std::uint32_t children = tree_.children(level);
        const RowMatrix coarser = rows.topRows(tree_.cells(level + 1));
        for (std::uint32_t m = 0; m < tree_.cells(level); ++m) {
            const Cell cell{level, m};
            const Eigen::Matrix4d& weights = frame(cell);
            for (std::uint32_t c = 0; c < children; ++c) {
                auto target = rows.row(children * m + c);
                target = weights(0, c) * coarser.row(m);
                for (std::uint32_t k = 1; k < children; ++k)
                    target += weights(k, c) * coarser.row(tree_.wavelet(cell, k));
            }
        }
    }
}

}  // namespace lightwell
