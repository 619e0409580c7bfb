#include "solver/series/neumann_series.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// One column of a matrix being put together.
struct Column {
    std::vector<int> row;
    std::vector<double> value;
};

Sparse assembled(Eigen::Index size, const std::vector<Column>& columns) {
    Sparse matrix(size, size);
    Sparse::StorageIndex* start = matrix.outerIndexPtr();
    for (std::size_t j = 0; j < columns.size(); ++j)
        start[j + 1] = start[j] + static_cast<Sparse::StorageIndex>(columns[j].row.size());
    matrix.resizeNonZeros(start[columns.size()]);
    tbb::parallel_for(std::size_t{0}, columns.size(), [&](std::size_t j) {
        std::copy(columns[j].row.begin(), columns[j].row.end(), matrix.innerIndexPtr() + start[j]);
        std::copy(columns[j].value.begin(), columns[j].value.end(), matrix.valuePtr() + start[j]);
    });
    return matrix;
}

/// A dense column with the list of rows that were touched.
struct Accumulator {
    std::vector<double> value;
    std::vector<char> is_touched;
    std::vector<int> touched;

    void add(int row, double amount) {
        const auto r = static_cast<std::size_t>(row);
        if (is_touched[r] == 0) {
            is_touched[r] = 1;
            touched.push_back(row);
        }
        value[r] += amount;
    }
};

/// A coefficient of the left factor of a product.
struct Factor {
    int row;
    double value;
    double size;  ///< |value|, by how much it matters what arrives in its row
};

/// The columns of a matrix, each with its largest coefficients first: those in rows of means, then
/// the others.
class LargestFirst {
  public:
    LargestFirst(const Sparse& matrix, const TruncationRule& rule)
        : start_(static_cast<std::size_t>(matrix.cols()) + 1, 0),
          end_of_means_(static_cast<std::size_t>(matrix.cols()), 0) {
        factors_.reserve(static_cast<std::size_t>(matrix.nonZeros()));
        for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
            for (Sparse::InnerIterator it(matrix, j); it; ++it) {
                const double matters = rule.visibility.size() == 0 ? 1 : rule.visibility[it.row()];
                factors_.push_back(
                    {static_cast<int>(it.row()), it.value(), std::abs(it.value()) * matters});
            }
            start_[static_cast<std::size_t>(j) + 1] = factors_.size();
        }
        tbb::parallel_for(
            std::size_t{0}, static_cast<std::size_t>(matrix.cols()), [this, &rule](std::size_t j) {
                const auto at = [&](std::size_t k) {
                    return factors_.begin() + static_cast<std::ptrdiff_t>(k);
                };
                const auto others =
                    std::partition(at(start_[j]), at(start_[j + 1]), [&rule](const Factor& factor) {
                        return rule.is_mean[static_cast<std::size_t>(factor.row)];
                    });
                const auto larger = [](const Factor& a, const Factor& b) {
                    return a.size != b.size ? a.size > b.size : a.row < b.row;
                };
                std::sort(at(start_[j]), others, larger);
                std::sort(others, at(start_[j + 1]), larger);
                end_of_means_[j] = static_cast<std::size_t>(others - factors_.begin());
            });
    }

    /// Adds `by` times those coefficients of a column that are of a size of at least `least`, or
    /// `least_of_means` in rows of means.
    void add(Eigen::Index column, double by, double least, double least_of_means,
             Accumulator& sum) const {
        const auto c = static_cast<std::size_t>(column);
        const std::size_t others = end_of_means_[c];
        for (std::size_t k = start_[c]; k < others && factors_[k].size >= least_of_means; ++k)
            sum.add(factors_[k].row, by * factors_[k].value);
        for (std::size_t k = others; k < start_[c + 1] && factors_[k].size >= least; ++k)
            sum.add(factors_[k].row, by * factors_[k].value);
    }

  private:
    std::vector<std::size_t> start_, end_of_means_;
    std::vector<Factor> factors_;
};

double largest_weighted(const Sparse& matrix, const TruncationRule& rule) {
    double largest = 0;
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
        for (Sparse::InnerIterator it(matrix, j); it; ++it)
            largest = std::max(largest, weighted(rule, it.row(), j, it.value()));
    return largest;
}

}  // namespace

double weighted(const TruncationRule& rule, Eigen::Index row, Eigen::Index column, double value) {
    const double size = std::abs(value) * rule.weight[column];
    return rule.visibility.size() == 0 ? size : size * rule.visibility[row];
}

bool is_kept(const TruncationRule& rule, Eigen::Index row, Eigen::Index column, double value) {
    return weighted(rule, row, column, value) >= rule.threshold ||
           (rule.is_mean[static_cast<std::size_t>(row)] &&
            rule.is_mean[static_cast<std::size_t>(column)]);
}

Sparse truncated(const Sparse& matrix, const TruncationRule& rule) {
    Sparse result = matrix;
    result.prune([&](const Eigen::Index& row, const Eigen::Index& column, const double& value) {
        return is_kept(rule, row, column, value);
    });
    return result;
}

Sparse truncated_product(const Sparse& a, const Sparse& b, const TruncationRule& rule,
                         const Progress& progress) {
    const auto n = static_cast<std::size_t>(a.rows());
    const double negligible = rule.negligible * rule.threshold;
    const LargestFirst sorted(negligible > 0 ? a : Sparse(a.rows(), 0), rule);
    const auto add_column = [&](Eigen::Index k, double by, Eigen::Index j, Accumulator& sum) {
        if (negligible > 0) {
            const double counts = std::abs(by) * rule.weight[j];
            const double least = counts > 0 ? negligible / counts : 0;
            const bool into_mean = rule.is_mean[static_cast<std::size_t>(j)];
            sorted.add(k, by, least, into_mean ? 0 : least, sum);
        } else {
            for (Sparse::InnerIterator ia(a, k); ia; ++ia)
                sum.add(static_cast<int>(ia.row()), ia.value() * by);
        }
    };
    std::vector<Column> columns(n);
    tbb::enumerable_thread_specific<Accumulator> accumulators([n] {
        return Accumulator{std::vector<double>(n, 0.0), std::vector<char>(n, 0), {}};
    });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 16), [&](const auto& range) {
        progress.check();
        Accumulator& sum = accumulators.local();
        for (std::size_t j = range.begin(); j != range.end(); ++j) {
            for (Sparse::InnerIterator ib(b, static_cast<Eigen::Index>(j)); ib; ++ib)
                add_column(ib.row(), ib.value(), static_cast<Eigen::Index>(j), sum);
            std::vector<int>& rows = columns[j].row;
            const auto is_wanted = [&](int row) {
                return is_kept(rule, row, static_cast<Eigen::Index>(j),
                               sum.value[static_cast<std::size_t>(row)]);
            };
            std::copy_if(sum.touched.begin(), sum.touched.end(), std::back_inserter(rows),
                         is_wanted);
            std::sort(rows.begin(), rows.end());
            for (const int row : rows)
                columns[j].value.push_back(sum.value[static_cast<std::size_t>(row)]);
            for (const int row : sum.touched) {
                sum.value[static_cast<std::size_t>(row)] = 0;
                sum.is_touched[static_cast<std::size_t>(row)] = 0;
            }
            sum.touched.clear();
        }
    });
    return assembled(a.rows(), columns);
}

NeumannSeries neumann_series(const Sparse& transport, const TruncationRule& rule,
                             const Progress& progress) {
    constexpr int most_doublings = 24;
    NeumannSeries series{truncated(transport, rule), 1};
    Sparse power = series.sum;
    // Even without truncation the series ends where a power no longer shows in the sum.
    const double smallest = std::max(rule.threshold, 1e-9 * largest_weighted(power, rule));
    for (int doubling = 0; doubling < most_doublings; ++doubling) {
        if (!(largest_weighted(power, rule) > smallest)) break;
        progress.say("series", static_cast<double>(doubling) / most_doublings);
        const Sparse square = truncated_product(power, power, rule, progress);
        // The first power is the sum so far.
        const Sparse next =
            doubling == 0 ? square : truncated_product(power, series.sum, rule, progress);
        power = square;
        series.sum = truncated(series.sum + next, rule);
        series.bounces *= 2;
    }
    return series;
}

}  // namespace lightwell
