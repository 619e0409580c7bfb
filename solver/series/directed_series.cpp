#include "solver/series/directed_series.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include <tbb/parallel_for.h>

#include "solver/series/neumann_series.h"
#include "solver/series/trial_lights.h"
#include "solver/series/truncation.h"

namespace lightwell {

namespace {

/// The budget of independent errors that comes near a measured one.
constexpr double independent_share = 0.3;

Rgb grey() {
    return Rgb::Constant(1.0 / 3);
}

using Fields = DirectedSolver::Fields;

/// Light as it is seen.
std::vector<Fields> seen(std::vector<Fields> lights, const DirectedSolver& solver,
                         const Eigen::ArrayXd& visibility) {
    const Reflection::Functions& functions = solver.functions();
    for (Fields& block : lights)
        for (std::size_t k = 0; k < functions.size(); ++k)
            block.row(static_cast<Eigen::Index>(k)) *= static_cast<float>(visibility[functions[k]]);
    return lights;
}

/// E + X, where either has light.
DirectedLights sum_of(const DirectedLights& direct, const Reflection::Functions& functions,
                      const Fields& indirect) {
    DirectedLights sum;
    std::set_union(direct.functions.begin(), direct.functions.end(), functions.begin(),
                   functions.end(), std::back_inserter(sum.functions));
    sum.values =
        Fields::Zero(static_cast<Eigen::Index>(sum.functions.size()), Fields::ColsAtCompileTime);
    const auto add = [&sum](const Reflection::Functions& of, const Fields& values) {
        std::size_t at = 0;
        for (std::size_t k = 0; k < of.size(); ++k) {
            while (sum.functions[at] < of[k])
                ++at;
            sum.values.row(static_cast<Eigen::Index>(at)) +=
                values.row(static_cast<Eigen::Index>(k));
        }
    };
    add(direct.functions, direct.values);
    add(functions, indirect);
    return sum;
}

/// No function is expected to stay dark: a light may come to stand where none of the ensemble did.
/// Raises every weight to a share of the root mean square over the functions of like support.
void raise_to_floor(const RadianceSpace& space, Eigen::ArrayXd& weight) {
    constexpr double share = 0.1;
    std::map<std::pair<int, int>, std::pair<double, double>> squares_and_count;
    std::vector<std::pair<int, int>> kind(static_cast<std::size_t>(weight.size()));
    for (const Element& element : space.elements()) {
        const CellTree& tree = element.space.tree();
        const std::uint32_t angles = element.angle.functions();
        for (std::uint32_t f = 0; f < tree.functions(); ++f) {
            const int size = std::ilogb(element.space.area(tree.support(f)));
            for (std::uint32_t a = 0; a < angles; ++a) {
                const auto j = element.first + f * angles + a;
                kind[j] = {size, a == 0 ? -1 : element.angle.level_of_function(a)};
                auto& [squares, count] = squares_and_count[kind[j]];
                squares += weight[j] * weight[j];
                count += 1;
            }
        }
    }
    for (Eigen::Index j = 0; j < weight.size(); ++j) {
        const auto& [squares, count] = squares_and_count[kind[static_cast<std::size_t>(j)]];
        weight[j] = std::max(weight[j], share * std::sqrt(squares / count));
    }
}

double squares_of(const Fields& block, Eigen::Index lane) {
    return block.col(lane).cast<double>().square().sum();
}

std::vector<double> magnitudes_of(const Eigen::SparseMatrix<double>& matrix,
                                  const TruncationRule& rule) {
    std::vector<double> magnitudes;
    magnitudes.reserve(static_cast<std::size_t>(matrix.nonZeros()));
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
        for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, j); it; ++it)
            magnitudes.push_back(weighted(rule, it.row(), j, it.value()));
    return magnitudes;
}

}  // namespace

DirectedEnsemble::DirectedEnsemble(const SymmetricOperator& propagation, const RadianceSpace& space,
                                   const Reflection& reflection)
    : propagation_(propagation),
      space_(space),
      reflection_(reflection),
      solver_(propagation, reflection, grey()),
      all_(space.functions()),
      direct_(Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(space.functions()))),
      outgoing_(direct_) {
    std::iota(all_.begin(), all_.end(), 0U);
}

void DirectedEnsemble::add(const std::vector<DirectedLights>& lights, const Progress& progress) {
    constexpr double rough = 0.02, least_share = 0.25;
    const std::vector<Fields> indirect =
        solver_.solved(propagation_, solver_.reflected(lights), rough, progress);
    double squares = 0, count = 0;
    for (const Fields& block : indirect) {
        for (Eigen::Index lane = 0; lane < block.cols(); ++lane) {
            const double square = squares_of(block, lane);
            squares += square;
            count += square > 0 ? 1 : 0;
        }
    }
    if (!(squares > 0)) return;
    const double least = least_share * squares / count;
    using Scale = Eigen::Array<double, Fields::ColsAtCompileTime, 1>;
    const auto weighed = [](const Fields& values, std::size_t k, const Scale& scale) {
        return (values.row(static_cast<Eigen::Index>(k)).cast<double>().square().transpose() *
                scale)
            .sum();
    };
    std::vector<Scale> scales(lights.size());
    std::vector<Eigen::ArrayXd> outgoing_squares(lights.size());
    tbb::parallel_for(std::size_t{0}, lights.size(), [&](std::size_t b) {
        for (Eigen::Index lane = 0; lane < Scale::RowsAtCompileTime; ++lane)
            scales[b][lane] = 1 / std::max(squares_of(indirect[b], lane), least);
        const DirectedLights incident = sum_of(lights[b], solver_.functions(), indirect[b]);
        Fields outgoing;
        reflection_.reflect(grey(), incident.functions, incident.values, all_, outgoing);
        outgoing_squares[b].resize(outgoing_.size());
        for (std::size_t k = 0; k < all_.size(); ++k)
            outgoing_squares[b][all_[k]] = weighed(outgoing, k, scales[b]);
    });
    for (std::size_t b = 0; b < lights.size(); ++b) {
        for (std::size_t k = 0; k < lights[b].functions.size(); ++k)
            direct_[lights[b].functions[k]] += weighed(lights[b].values, k, scales[b]);
        outgoing_ += outgoing_squares[b];
    }
    lights_ += count;
}

DirectedWeights DirectedEnsemble::weights() const {
    const Eigen::Index n = direct_.size();
    if (!(lights_ > 0)) return {Eigen::ArrayXd::Ones(n), Eigen::ArrayXd::Ones(n)};
    DirectedWeights weights{(direct_ / lights_).sqrt(), (outgoing_ / lights_).sqrt()};
    raise_to_floor(space_, weights.direct);
    raise_to_floor(space_, weights.outgoing);
    return weights;
}

Eigen::SparseMatrix<double> reflection_into(const Eigen::SparseMatrix<double>& propagation,
                                            const Reflection& reflection, const Rgb& shares) {
    constexpr double smallest = 2e-4;
    std::vector<bool> leaving(static_cast<std::size_t>(propagation.cols()));
    for (std::size_t j = 0; j < leaving.size(); ++j)
        leaving[j] = propagation.outerIndexPtr()[j + 1] > propagation.outerIndexPtr()[j];
    return reflection.matrix(shares, smallest, leaving);
}

SymmetricOperator truncated_propagation(BounceTruncation truncation, const DirectedWeights& weights,
                                        const Reflection& reflection,
                                        const std::vector<DirectedLights>& tried, double target,
                                        const Progress& progress) {
    if (target == 0 || tried.empty()) return truncation.at(0);
    // What a much tighter threshold keeps stands for everything: the rest would cost minutes.
    constexpr double close_enough = 1e-3, negligible = 0.1;
    const Eigen::ArrayXd visibility = reflection.visibility(grey());
    truncation.weigh(weights.outgoing, visibility);
    const double budget = independent_share * target;
    const double guess = truncation.threshold_for(budget);
    const double tight = truncation.threshold_for(negligible * budget);
    truncation.forget_below(tight);
    const SymmetricOperator all = truncation.at(tight);
    const DirectedSolver solver(all, reflection, grey());
    const std::vector<Fields> reflected = solver.reflected(tried);
    const auto light_on = [&](const SymmetricOperator& propagation) {
        return seen(solver.solved(propagation, reflected, close_enough, progress), solver,
                    visibility);
    };
    const std::vector<Fields> reference = light_on(all);
    const double threshold = calibrated_threshold(guess, target, [&](double at) {
        return relative_change(light_on(truncation.at(at)), reference);
    });
    return truncation.at(std::max(threshold, tight));
}

namespace {

/// H of one channel, within the target.
NeumannSeries truncated_series(const Eigen::SparseMatrix<double>& propagation,
                               const GlobalTransport& transport, const Rgb& shares,
                               const std::vector<DirectedLights>& tried, double target,
                               TruncationRule rule, const Eigen::ArrayXd& outgoing,
                               const Progress& progress) {
    const Eigen::SparseMatrix<double> reflection =
        reflection_into(propagation, transport.reflection, shares);
    if (target == 0 || tried.empty()) {
        rule.threshold = 0;
        return neumann_series(truncated_product(propagation, reflection, rule, progress), rule,
                              progress);
    }
    // Measured on the sample scenes: leaving out terms below a tenth of the threshold changes the
    // error by two per cent of itself and takes a tenth of the time.
    constexpr double negligible_terms = 0.1;
    constexpr double share_of_powers = 0.75, close_enough = 1e-3;
    constexpr int most_passes = 4;
    rule.negligible = negligible_terms;
    const DirectedSolver solver(transport.bounce, transport.reflection, shares);
    const std::vector<Fields> solved =
        seen(solver.solved(transport.bounce, solver.reflected(tried), close_enough, progress),
             solver, rule.visibility);
    const auto error_of = [&](const Eigen::SparseMatrix<double>& sum, const TruncationRule& with) {
        return relative_change(
            seen(solver.truncated_indirect(sum, with, tried), solver, rule.visibility), solved);
    };
    // A first T by what its own coefficients cost; the powers are truncated while they are formed,
    // and if that alone costs too much, less is.
    constexpr double negligible = 0.2;
    TruncationRule first = rule;
    first.weight = outgoing;
    first.threshold = negligible * threshold_for_budget(magnitudes_of(propagation, first),
                                                        independent_share * target);
    first.weight = rule.weight;
    const Eigen::SparseMatrix<double> one_bounce =
        truncated_product(propagation, reflection, first, progress);
    const double guess =
        threshold_for_budget(magnitudes_of(one_bounce, rule), independent_share * target);
    rule.threshold = 0.5 * guess;
    NeumannSeries series;
    for (int pass = 0; pass < most_passes; ++pass) {
        series = neumann_series(one_bounce, rule, progress);
        const double error = error_of(series.sum, rule), wanted = share_of_powers * target;
        if (error <= wanted) break;
        // The error grows with about the 0.6th power of the threshold.
        rule.threshold *= std::clamp(0.9 * std::pow(wanted / error, 1.6), 0.25, 0.8);
    }
    TruncationRule wider = rule;
    const double threshold = calibrated_threshold(guess, target, [&](double at) {
        wider.threshold = at;
        return error_of(series.sum, wider);
    });
    if (threshold > rule.threshold) {
        rule.threshold = threshold;
        series.sum = truncated(series.sum, rule);
    }
    return series;
}

/// The area [m2] from which on there are at most `count` elements.
double area_of_largest(const RadianceSpace& space, std::size_t count) {
    std::vector<double> areas;
    for (const Element& element : space.elements())
        areas.push_back(element.area());
    if (areas.size() <= count) return 0;
    std::sort(areas.begin(), areas.end(), std::greater<>());
    return std::nextafter(areas[count], std::numeric_limits<double>::infinity());
}

}  // namespace

void sum_directed_series(const DirectedWeights& weights, const std::vector<DirectedLights>& tried,
                         double target, const Progress& progress, GlobalTransport& transport) {
    TruncationRule rule;
    rule.weight = weights.direct;
    // Means keep the energy, and there are the square of the elements of them: of the facets of a
    // ball, which are thousands and carry next to none, those of the largest are enough.
    constexpr std::size_t most_means = 400;
    const double smallest = area_of_largest(transport.space, most_means);
    rule.is_mean.assign(transport.space.functions(), false);
    for (const Element& element : transport.space.elements())
        rule.is_mean[element.first] = element.area() >= smallest;
    const Eigen::SparseMatrix<double> propagation =
        to_matrix(transport.bounce,
                  Eigen::ArrayXd::Ones(static_cast<Eigen::Index>(transport.space.functions())));
    std::vector<int> first_of;  // the first channel that uses each operator
    for (int c = 0; c < 3; ++c) {
        const auto same = std::find_if(first_of.begin(), first_of.end(), [&](int earlier) {
            return transport.reflection.are_alike(earlier, c);
        });
        transport.channel[static_cast<std::size_t>(c)] = static_cast<int>(same - first_of.begin());
        if (same == first_of.end()) first_of.push_back(c);
    }
    std::vector<NeumannSeries> series(first_of.size());
    tbb::parallel_for(std::size_t{0}, first_of.size(), [&](std::size_t k) {
        Rgb shares = Rgb::Zero();
        shares[first_of[k]] = 1;
        TruncationRule of_channel = rule;
        of_channel.visibility = transport.reflection.visibility(shares);
        series[k] = truncated_series(propagation, transport, shares, tried, target, of_channel,
                                     weights.outgoing, progress);
    });
    for (NeumannSeries& one : series) {
        transport.indirect.push_back(to_operator(one.sum));
        transport.provenance.bounces = std::max(transport.provenance.bounces, one.bounces);
        one = {};
    }
}

}  // namespace lightwell
