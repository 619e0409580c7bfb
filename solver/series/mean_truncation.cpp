#include "solver/series/mean_truncation.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace lightwell {

namespace {

bool joins_means(const TruncationRule& rule, Eigen::Index row, Eigen::Index column) {
    return rule.is_mean[static_cast<std::size_t>(row)] &&
           rule.is_mean[static_cast<std::size_t>(column)];
}

/// The size below which the smallest may go that add up to at most a share of all.
double least_kept(std::vector<double>& sizes, double share) {
    std::sort(sizes.begin(), sizes.end());
    double all = 0;
    for (const double size : sizes)
        all += size;
    double sum = 0;
    for (const double size : sizes) {
        sum += size;
        if (sum > share * all) return size;
    }
    return 0;
}

}  // namespace

Eigen::SparseMatrix<double> without_small_means(const Eigen::SparseMatrix<double>& matrix,
                                                const TruncationRule& rule, double share) {
    if (share == 0) return matrix;
    std::vector<std::vector<double>> sizes(static_cast<std::size_t>(matrix.rows()));
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
        for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, j); it; ++it)
            if (joins_means(rule, it.row(), j))
                sizes[static_cast<std::size_t>(it.row())].push_back(std::abs(it.value()) *
                                                                    rule.weight[j]);
    std::vector<double> least;
    for (std::vector<double>& row : sizes)
        least.push_back(least_kept(row, share));
    Eigen::SparseMatrix<double> result = matrix;
    result.prune([&](const Eigen::Index& row, const Eigen::Index& column, const double& value) {
        return !joins_means(rule, row, column) ||
               std::abs(value) * rule.weight[column] >= least[static_cast<std::size_t>(row)];
    });
    return result;
}

}  // namespace lightwell
