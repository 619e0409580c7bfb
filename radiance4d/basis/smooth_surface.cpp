#include "radiance4d/basis/smooth_surface.h"

#include <algorithm>

namespace lightwell {

namespace {

/// Value at interface i (between means i-1 and i) of n means a(0) .. a(n-1).
template <typename Means>
Rgb interface_value(const Means& a, Eigen::Index i, Eigen::Index n) {
    if (n == 1) return a(0);
    const bool at_start = i == 0, at_end = i == n;
    if (at_start || at_end) {
        // One-sided: the parabola through three means, or the line through two.
        const auto from_rim = [&](Eigen::Index k) { return at_start ? a(k) : a(n - 1 - k); };
        const Rgb first = from_rim(0), second = from_rim(1);
        const Rgb wanted = n == 2 ? Rgb(0.5 * (first - second))
                                  : Rgb((5 * first - 7 * second + 2 * from_rim(2)) / 6);
        const Rgb step = first - second;
        const Rgb low = step.min(0.0), high = step.max(0.0);
        return (first + wanted.max(low).min(high)).max(0.0);
    }
    const Rgb before = a(i - 1), after = a(i);
    Rgb value = 0.5 * (before + after);
    if (n >= 3) {
        // Fourth order inside; third order next to the rim.
        if (i == 1)
            value = (2 * before + 5 * after - a(2)) / 6;
        else if (i == n - 1)
            value = (2 * after + 5 * before - a(n - 3)) / 6;
        else
            value = (7 * (before + after) - a(i - 2) - a(i + 1)) / 12;
    }
    return value.max(before.min(after)).min(before.max(after));
}

/// The parabola on [0,1] with values l and r at the ends and mean m.
Rgb parabola(const Rgb& l, const Rgb& m, const Rgb& r, double t) {
    return l + t * ((r - l) + 6 * (m - 0.5 * (l + r)) * (1 - t));
}

}  // namespace

SmoothSurface::SmoothSurface(const CellTree& tree,
                             const Eigen::Array<double, Eigen::Dynamic, 3>& means)
    : columns_(tree.columns()), rows_(tree.rows()), stride_(2 * columns_ + 1) {
    nodes_.resize(stride_ * (2 * rows_ + 1), 3);
    for (Eigen::Index j = 0; j < rows_; ++j)
        for (Eigen::Index i = 0; i < columns_; ++i)
            nodes_.row((2 * j + 1) * stride_ + 2 * i + 1) = means.row(
                tree.finest_at(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)));
    // Along u: means over the edges between columns. Then along v: rows of interfaces from rows of
    // means.
    for (Eigen::Index j = 0; j < rows_; ++j) {
        const auto in_row = [&](Eigen::Index i) { return node(2 * i + 1, 2 * j + 1); };
        for (Eigen::Index i = 0; i <= columns_; ++i)
            nodes_.row((2 * j + 1) * stride_ + 2 * i) =
                interface_value(in_row, i, columns_).transpose();
    }
    for (Eigen::Index k = 0; k < stride_; ++k) {
        const auto in_column = [&](Eigen::Index j) { return node(k, 2 * j + 1); };
        for (Eigen::Index j = 0; j <= rows_; ++j)
            nodes_.row(2 * j * stride_ + k) = interface_value(in_column, j, rows_).transpose();
    }
}

Rgb SmoothSurface::at(double u, double v) const {
    const double x = std::clamp(u, 0.0, 1.0) * static_cast<double>(columns_);
    const double y = std::clamp(v, 0.0, 1.0) * static_cast<double>(rows_);
    const Eigen::Index i = std::min(static_cast<Eigen::Index>(x), columns_ - 1);
    const Eigen::Index j = std::min(static_cast<Eigen::Index>(y), rows_ - 1);
    const double s = x - static_cast<double>(i), t = y - static_cast<double>(j);
    const auto along_v = [&](Eigen::Index k) {
        return parabola(node(k, 2 * j), node(k, 2 * j + 1), node(k, 2 * j + 2), t);
    };
    return parabola(along_v(2 * i), along_v(2 * i + 1), along_v(2 * i + 2), s).max(0.0);
}

}  // namespace lightwell
