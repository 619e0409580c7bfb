#include "radiance4d/operator/transport_operator.h"

#include "radiance4d/failure.h"

namespace lightwell {

void TransportOperator::apply(Eigen::Ref<const Eigen::ArrayXd> x,
                              Eigen::Ref<Eigen::ArrayXd> y) const {
    LIGHTWELL_CHECK_OP(x.size(), ==, static_cast<Eigen::Index>(size));
    LIGHTWELL_CHECK_OP(y.size(), ==, static_cast<Eigen::Index>(size));
    for (std::uint32_t column = 0; column < size; ++column) {
        const double factor = x[column];
        if (factor == 0) continue;
        for (std::uint64_t k = column_start[column]; k < column_start[column + 1]; ++k)
            y[row[k]] += static_cast<double>(value[k]) * factor;
    }
}

void SymmetricOperator::apply(Eigen::Ref<const Eigen::ArrayXd> x,
                              Eigen::Ref<Eigen::ArrayXd> y) const {
    LIGHTWELL_CHECK_OP(x.size(), ==, static_cast<Eigen::Index>(upper.size));
    LIGHTWELL_CHECK_OP(y.size(), ==, static_cast<Eigen::Index>(upper.size));
    for (std::uint32_t column = 0; column < upper.size; ++column) {
        const double factor = x[column];
        double gathered = 0;
        for (std::uint64_t k = upper.column_start[column]; k < upper.column_start[column + 1];
             ++k) {
            const std::uint32_t row = upper.row[k];
            const double value = static_cast<double>(upper.value[k]);
            y[row] += value * factor;
            if (row != column) gathered += value * x[row];
        }
        y[column] += gathered;
    }
}

TransportOperator to_operator(const Eigen::SparseMatrix<double>& matrix) {
    LIGHTWELL_CHECK_OP(matrix.rows(), ==, matrix.cols());
    TransportOperator result;
    result.size = static_cast<std::uint32_t>(matrix.rows());
    result.column_start.assign(1, 0);
    result.row.reserve(static_cast<std::size_t>(matrix.nonZeros()));
    result.value.reserve(static_cast<std::size_t>(matrix.nonZeros()));
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
        for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, column); it; ++it) {
            result.row.push_back(static_cast<std::uint32_t>(it.row()));
            result.value.push_back(static_cast<float>(it.value()));
        }
        result.column_start.push_back(result.value.size());
    }
    return result;
}

Eigen::SparseMatrix<double> to_matrix(const SymmetricOperator& operator_,
                                      const Eigen::ArrayXd& column_scale) {
    const TransportOperator& upper = operator_.upper;
    std::vector<Eigen::Triplet<double, int>> entries;
    entries.reserve(2 * upper.value.size());
    for (std::uint32_t column = 0; column < upper.size; ++column) {
        for (std::uint64_t k = upper.column_start[column]; k < upper.column_start[column + 1];
             ++k) {
            const std::uint32_t row = upper.row[k];
            const double value = static_cast<double>(upper.value[k]);
            if (column_scale[column] != 0)
                entries.emplace_back(static_cast<int>(row), static_cast<int>(column),
                                     value * column_scale[column]);
            if (row != column && column_scale[row] != 0)
                entries.emplace_back(static_cast<int>(column), static_cast<int>(row),
                                     value * column_scale[row]);
        }
    }
    Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(upper.size),
                                       static_cast<Eigen::Index>(upper.size));
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

}  // namespace lightwell
