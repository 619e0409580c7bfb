#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "radiance4d/basis/haar.h"

namespace lightwell::testing {

/// Numbers spread evenly over [low, high], the same in every run.
class Numbers {
  public:
    explicit Numbers(unsigned seed) : bits_(seed) {}
    double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(bits_()) + 0.5) / 4294967296.0;
    }
    RowMatrix matrix(Eigen::Index rows, Eigen::Index columns, double low = -1, double high = 1) {
        RowMatrix result(rows, columns);
        for (Eigen::Index i = 0; i < rows; ++i)
            for (Eigen::Index j = 0; j < columns; ++j)
                result(i, j) = between(low, high);
        return result;
    }
    Vec3 vector(double low, double high) {
        const double x = between(low, high), y = between(low, high), z = between(low, high);
        return {x, y, z};
    }

  private:
    std::mt19937 bits_;
};

/// Trees of every kind: none, square, elongated, mixed.
inline std::vector<CellTree> sample_trees() {
    using S = Split;
    return {CellTree(),
            CellTree({S::both}),
            CellTree({S::u}),
            CellTree({S::v}),
            CellTree({S::both, S::both, S::both}),
            CellTree({S::u, S::u, S::both}),
            CellTree({S::v, S::both, S::both}),
            CellTree({S::both, S::u, S::v, S::both}),
            CellTree({S::u, S::v, S::both})};
}

inline Quad unit_square() {
    return Quad{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}};
}

/// Lines of constant u converge: no two cells of a row have equal areas.
inline Quad trapezoid() {
    return Quad{{Vec3(0, 0, 1), Vec3(3, 0, 1), Vec3(2, 1, 1), Vec3(0.5, 1.5, 1)}};
}

/// The basis the slow way: each function over each finest cell, in units of that cell's scaling
/// function, by walking from the function's support down to the cell.
inline Eigen::MatrixXd explicit_basis(const HaarBasis& basis) {
    const CellTree& tree = basis.tree();
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(tree.functions(), tree.functions());
    for (std::uint32_t f = 0; f < tree.functions(); ++f) {
        const Cell support = tree.support(f);
        for (std::uint32_t m = 0; m < tree.functions(); ++m) {
            // Share of the cell's scaling function in that of the cells above it, up to the child
            // of the support.
            Cell at{tree.levels(), m};
            while (at.level > support.level + 1)
                at = tree.parent(at);
            const Cell below = at;
            if (f == 0 || tree.levels() == 0) {
                result(f, m) = std::sqrt(basis.area({tree.levels(), m}) / basis.area({}));
                continue;
            }
            if (!(tree.parent(below) == support)) continue;
            const std::uint32_t k =
                (f - tree.cells(support.level)) % (tree.children(support.level) - 1) + 1;
            const std::uint32_t c = below.index % tree.children(support.level);
            result(f, m) = basis.frame(support)(k, c) *
                           std::sqrt(basis.area({tree.levels(), m}) / basis.area(below));
        }
    }
    return result;
}

}  // namespace lightwell::testing
