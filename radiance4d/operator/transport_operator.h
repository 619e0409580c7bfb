#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace lightwell {

/// A sparse matrix in the standard operator decomposition, receiver basis x sender basis,
/// compressed by columns: a column holds what one sender function gives to all receivers. Values
/// are floats, as in the file.
struct TransportOperator {
    std::uint32_t size = 0;                   ///< rows and columns
    std::vector<std::uint64_t> column_start;  ///< size + 1 offsets into row and value
    std::vector<std::uint32_t> row;           ///< ascending within a column
    std::vector<float> value;

    std::uint64_t coefficients() const { return value.size(); }
    /// y <- y + A x, touching only the columns where x is not zero.
    void apply(Eigen::Ref<const Eigen::ArrayXd> x, Eigen::Ref<Eigen::ArrayXd> y) const;
};

/// A symmetric operator of which each unordered pair is stored once: the entries with row <=
/// column.
struct SymmetricOperator {
    TransportOperator upper;

    std::uint64_t coefficients() const { return upper.coefficients(); }
    /// y <- y + A x.
    void apply(Eigen::Ref<const Eigen::ArrayXd> x, Eigen::Ref<Eigen::ArrayXd> y) const;
};

/// Column-compressed copy in single precision.
TransportOperator to_operator(const Eigen::SparseMatrix<double>& matrix);

/// The full matrix A diag(scale), in double precision.
Eigen::SparseMatrix<double> to_matrix(const SymmetricOperator& operator_,
                                      const Eigen::ArrayXd& column_scale);

}  // namespace lightwell
