#include "solver/series/directed_solver.h"

#include <algorithm>
#include <utility>

#include <tbb/parallel_for.h>

#include "radiance4d/failure.h"
#include "solver/series/trial_lights.h"

namespace lightwell {

namespace {

using Fields = DirectedSolver::Fields;
constexpr Eigen::Index lanes = Fields::ColsAtCompileTime;

}  // namespace

DirectedLights DirectedLights::of(const std::vector<Eigen::ArrayXd>& fields) {
    LIGHTWELL_CHECK_OP(fields.size(), >=, std::size_t{1});
    LIGHTWELL_CHECK_OP(fields.size(), <=, static_cast<std::size_t>(lanes));
    DirectedLights lights;
    for (Eigen::Index j = 0; j < fields.front().size(); ++j)
        if (std::any_of(fields.begin(), fields.end(),
                        [j](const Eigen::ArrayXd& field) { return field[j] != 0; }))
            lights.functions.push_back(static_cast<std::uint32_t>(j));
    lights.values = Fields::Zero(static_cast<Eigen::Index>(lights.functions.size()), lanes);
    for (std::size_t k = 0; k < lights.functions.size(); ++k)
        for (std::size_t lane = 0; lane < fields.size(); ++lane)
            lights.values(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(lane)) =
                static_cast<float>(fields[lane][lights.functions[k]]);
    return lights;
}

DirectedSolver::DirectedSolver(const SymmetricOperator& propagation, const Reflection& reflection,
                               Rgb shares)
    : reflection_(reflection), shares_(std::move(shares)), place_(propagation.upper.size, 0) {
    const TransportOperator& upper = propagation.upper;
    std::vector<bool> is_reached(upper.size, false);
    for (std::uint32_t column = 0; column < upper.size; ++column) {
        for (std::uint64_t k = upper.column_start[column]; k < upper.column_start[column + 1];
             ++k) {
            is_reached[upper.row[k]] = true;
            is_reached[column] = true;
        }
    }
    for (std::uint32_t j = 0; j < upper.size; ++j) {
        if (!is_reached[j]) continue;
        place_[j] = static_cast<std::uint32_t>(functions_.size());
        functions_.push_back(j);
    }
}

SymmetricOperator DirectedSolver::restricted(const SymmetricOperator& propagation) const {
    SymmetricOperator result;
    TransportOperator& upper = result.upper;
    upper.size = static_cast<std::uint32_t>(functions_.size());
    upper.column_start.assign(1, 0);
    for (const std::uint32_t column : functions_)
        upper.column_start.push_back(upper.column_start.back() +
                                     propagation.upper.column_start[column + 1] -
                                     propagation.upper.column_start[column]);
    LIGHTWELL_CHECK_OP(upper.column_start.back(), ==, propagation.coefficients());
    upper.row.reserve(propagation.upper.row.size());
    for (const std::uint32_t row : propagation.upper.row)
        upper.row.push_back(place_[row]);
    upper.value = propagation.upper.value;
    return result;
}

std::vector<Fields> DirectedSolver::reflected(const std::vector<DirectedLights>& direct) const {
    std::vector<Fields> result(direct.size());
    tbb::parallel_for(std::size_t{0}, direct.size(), [&](std::size_t b) {
        reflection_.reflect(shares_, direct[b].functions, direct[b].values, functions_, result[b]);
    });
    return result;
}

std::vector<Fields> DirectedSolver::solved(const SymmetricOperator& propagation,
                                           const std::vector<Fields>& reflected, double tolerance,
                                           const Progress& progress) const {
    constexpr int most_steps = 400;
    const SymmetricOperator between = restricted(propagation);
    std::vector<Fields> solved(reflected.size());
    tbb::parallel_for(std::size_t{0}, reflected.size(), [&](std::size_t b) {
        Fields& x = solved[b];
        x = Fields::Zero(reflected[b].rows(), lanes);
        Fields outgoing = reflected[b], next;
        for (int step = 0; step < most_steps; ++step) {
            progress.check();
            propagate(between, outgoing, next);
            const float change = (next - x).matrix().norm();
            std::swap(x, next);
            if (static_cast<double>(change) <= tolerance * static_cast<double>(x.matrix().norm()))
                break;
            reflection_.reflect(shares_, functions_, x, functions_, outgoing);
            outgoing += reflected[b];
        }
    });
    return solved;
}

std::vector<Fields> DirectedSolver::truncated_indirect(
    const Eigen::SparseMatrix<double>& global, const TruncationRule& rule,
    const std::vector<DirectedLights>& direct) const {
    std::vector<Fields> result(direct.size());
    tbb::parallel_for(std::size_t{0}, direct.size(), [&](std::size_t b) {
        Fields& y = result[b];
        y = Fields::Zero(static_cast<Eigen::Index>(functions_.size()), lanes);
        for (std::size_t k = 0; k < direct[b].functions.size(); ++k) {
            const std::uint32_t column = direct[b].functions[k];
            const auto light = direct[b].values.row(static_cast<Eigen::Index>(k));
            for (Eigen::SparseMatrix<double>::InnerIterator it(global, column); it; ++it)
                if (is_kept(rule, it.row(), column, it.value()))
                    y.row(place_[static_cast<std::size_t>(it.row())]) +=
                        static_cast<float>(it.value()) * light;
        }
    });
    return result;
}

}  // namespace lightwell
