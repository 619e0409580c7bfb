#include "solver/series/trial_lights.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace lightwell {

namespace {

constexpr Eigen::Index lanes = LightBlock::ColsAtCompileTime;

/// sum_j h_ij x_j over the coefficients that `is_kept(i, j, h_ij)`.
template <typename IsKept>
LightBlock applied(const Eigen::SparseMatrix<double>& global, const LightBlock& x,
                   const IsKept& is_kept) {
    LightBlock y = LightBlock::Zero(x.rows(), lanes);
    for (Eigen::Index j = 0; j < global.cols(); ++j) {
        if (!(x.row(j) != 0).any()) continue;
        for (Eigen::SparseMatrix<double>::InnerIterator it(global, j); it; ++it)
            if (is_kept(it.row(), j, it.value())) y.row(it.row()) += it.value() * x.row(j);
    }
    return y;
}

template <typename Block>
void propagate_block(const SymmetricOperator& bounce, const Block& x, Block& y) {
    y.setZero(x.rows(), lanes);
    const TransportOperator& upper = bounce.upper;
    for (std::uint32_t column = 0; column < upper.size; ++column) {
        for (std::uint64_t k = upper.column_start[column]; k < upper.column_start[column + 1];
             ++k) {
            const std::uint32_t row = upper.row[k];
            const auto value = static_cast<typename Block::Scalar>(upper.value[k]);
            y.row(row) += value * x.row(column);
            if (row != column) y.row(column) += value * x.row(row);
        }
    }
}

template <typename Block>
double change_of(const std::vector<Block>& changed, const std::vector<Block>& reference) {
    std::vector<double> difference, norm;
    double squares = 0;
    for (std::size_t b = 0; b < reference.size(); ++b) {
        for (Eigen::Index lane = 0; lane < lanes; ++lane) {
            const auto lit = reference[b].col(lane).template cast<double>();
            const double square = lit.square().sum();
            if (square == 0) continue;  // filled up
            norm.push_back(square);
            difference.push_back(
                (changed[b].col(lane).template cast<double>() - lit).square().sum());
            squares += square;
        }
    }
    if (norm.empty()) return 0;
    const auto count = static_cast<double>(norm.size());
    double sum = 0;
    for (std::size_t k = 0; k < norm.size(); ++k)
        sum += difference[k] / std::max(norm[k], 0.25 * squares / count);
    return std::sqrt(sum / count);
}

}  // namespace

LightBlock propagated(const SymmetricOperator& bounce, const LightBlock& x) {
    LightBlock y;
    propagate_block(bounce, x, y);
    return y;
}

void propagate(const SymmetricOperator& bounce, const Reflection::Fields& x,
               Reflection::Fields& y) {
    propagate_block(bounce, x, y);
}

TrialLights trial_lights(const std::vector<Eigen::ArrayXd>& fields) {
    TrialLights blocks;
    for (std::size_t k = 0; k < fields.size(); ++k) {
        const auto lane = static_cast<Eigen::Index>(k) % lanes;
        if (lane == 0) blocks.emplace_back(LightBlock::Zero(fields[k].size(), lanes));
        blocks.back().col(lane) = fields[k];
    }
    return blocks;
}

TrialLights solved_indirect(const SymmetricOperator& bounce, const Eigen::ArrayXd& reflectance,
                            const Eigen::SparseMatrix<double>* global, const TrialLights& direct,
                            const Progress& progress) {
    constexpr int most_steps = 40;
    constexpr double tolerance = 1e-4;
    TrialLights solved(direct.size());
    tbb::parallel_for(std::size_t{0}, direct.size(), [&](std::size_t b) {
        LightBlock& x = solved[b];
        x = LightBlock::Zero(direct[b].rows(), lanes);
        const auto all = [](Eigen::Index, Eigen::Index, double) { return true; };
        for (int step = 0; step < most_steps; ++step) {
            progress.check();
            const LightBlock outgoing = (direct[b] + x).colwise() * reflectance;
            LightBlock correction = propagated(bounce, outgoing) - x;
            if (global != nullptr) correction += applied(*global, correction, all);
            x += correction;
            if (correction.matrix().norm() <= tolerance * x.matrix().norm()) break;
        }
    });
    return solved;
}

TrialLights truncated_indirect(const Eigen::SparseMatrix<double>& global,
                               const TruncationRule& rule, const TrialLights& direct) {
    TrialLights result(direct.size());
    tbb::parallel_for(std::size_t{0}, direct.size(), [&](std::size_t b) {
        result[b] = applied(global, direct[b],
                            [&rule](Eigen::Index row, Eigen::Index column, double value) {
                                return is_kept(rule, row, column, value);
                            });
    });
    return result;
}

double relative_change(const TrialLights& changed, const TrialLights& reference) {
    return change_of(changed, reference);
}

double relative_change(const std::vector<Reflection::Fields>& changed,
                       const std::vector<Reflection::Fields>& reference) {
    return change_of(changed, reference);
}

double calibrated_threshold(double guess, double wanted,
                            const std::function<double(double)>& error_at) {
    constexpr int most_trials = 8;
    constexpr double close_enough = 0.05;
    // Below this factor a step is as good as any other: the error may be flat there.
    constexpr double largest_step = 8;
    double best = 0, threshold = guess, slope = 0.7;
    double last_threshold = 0, last_error = 0;
    for (int trial = 0; trial < most_trials; ++trial) {
        const double error = error_at(threshold);
        if (error <= wanted) best = std::max(best, threshold);
        if (error <= wanted && error >= (1 - close_enough) * wanted) break;
        if (trial > 0 && error > 0 && last_error > 0 && threshold != last_threshold) {
            const double measured =
                std::log(error / last_error) / std::log(threshold / last_threshold);
            slope = std::clamp(measured, 0.2, 2.0);
        }
        last_threshold = threshold;
        last_error = error;
        // Aims a little below, since what is above does not count.
        const double step = error > 0 ? std::pow(0.975 * wanted / error, 1 / slope) : largest_step;
        threshold *= std::clamp(step, 1 / largest_step, largest_step);
    }
    return best;
}

}  // namespace lightwell
