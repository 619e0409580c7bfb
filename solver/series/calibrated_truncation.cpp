#include "solver/series/calibrated_truncation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "radiance4d/failure.h"
#include "solver/series/mean_truncation.h"
#include "solver/series/truncation.h"

namespace lightwell {

namespace {

/// Of the target of truncation, what coefficients between means may make.
constexpr double share_of_means = 0.01;

/// The budget of independent errors that comes near a measured one.
constexpr double independent_share = 0.3;

std::vector<double> magnitudes_of(const Eigen::SparseMatrix<double>& matrix,
                                  const Eigen::ArrayXd& weight) {
    std::vector<double> magnitudes;
    magnitudes.reserve(static_cast<std::size_t>(matrix.nonZeros()));
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
        for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, j); it; ++it)
            magnitudes.push_back(std::abs(it.value()) * weight[j]);
    return magnitudes;
}

/// H of one channel, within the target.
NeumannSeries truncated_series(const SymmetricOperator& bounce, const Eigen::ArrayXd& reflectance,
                               const TrialLights& tried, double target, TruncationRule rule,
                               const Progress& progress) {
    const Eigen::SparseMatrix<double> one_bounce = to_matrix(bounce, reflectance);
    if (target == 0 || tried.empty()) {
        rule.threshold = 0;
        return neumann_series(one_bounce, rule, progress);
    }
    // The powers themselves are truncated while they are formed; if that alone costs too much, less
    // is.
    constexpr double share_of_powers = 0.75;
    constexpr int most_passes = 4;
    const double guess =
        threshold_for_budget(magnitudes_of(one_bounce, rule.weight), independent_share * target);
    rule.threshold = 0.5 * guess;
    NeumannSeries series;
    TrialLights solved;
    for (int pass = 0; pass < most_passes; ++pass, rule.threshold *= 0.4) {
        series = neumann_series(one_bounce, rule, progress);
        if (pass == 0) solved = solved_indirect(bounce, reflectance, &series.sum, tried, progress);
        if (relative_change(truncated_indirect(series.sum, rule, tried), solved) <=
            share_of_powers * target)
            break;
    }
    TruncationRule wider = rule;
    const double threshold = calibrated_threshold(guess, target, [&](double at) {
        wider.threshold = at;
        return relative_change(truncated_indirect(series.sum, wider, tried), solved);
    });
    if (threshold > rule.threshold) {
        rule.threshold = threshold;
        series.sum = truncated(series.sum, rule);
    }
    return series;
}

bool is_finite(const Eigen::SparseMatrix<double>& matrix) {
    return std::all_of(matrix.valuePtr(), matrix.valuePtr() + matrix.nonZeros(),
                       [](double value) { return std::isfinite(value); });
}

}  // namespace

SymmetricOperator truncated_bounce(BounceTruncation truncation, const TrialLights& tried,
                                   const Eigen::ArrayXd& reflectance,
                                   const TruncationTarget& target, const Progress& progress) {
    if (target.bounce == 0 || tried.empty()) return truncation.at(0);
    // What a much tighter threshold keeps stands for everything: the rest would cost minutes.
    constexpr double negligible = 0.1;
    const double budget = independent_share * target.bounce;
    const double guess = truncation.threshold_for(budget);
    const double tight = truncation.threshold_for(negligible * budget);
    truncation.forget_below(tight);
    const auto light_on = [&](double threshold) {
        return solved_indirect(truncation.at(threshold), reflectance, nullptr, tried, progress);
    };
    const TrialLights reference = light_on(tight);
    const double threshold = calibrated_threshold(
        guess, target.bounce, [&](double at) { return relative_change(light_on(at), reference); });
    return truncation.at(std::max(threshold, tight));
}

void sum_series(const Eigen::ArrayXd& weight, const TrialLights& tried,
                const TruncationTarget& target, const Progress& progress,
                GlobalTransport& transport) {
    const RadianceField rho = reflectance_of(transport.scene, transport.space);
    TruncationRule rule;
    rule.weight = weight;
    rule.is_mean.assign(transport.space.functions(), false);
    for (const Element& element : transport.space.elements())
        rule.is_mean[element.first] = true;
    std::vector<int> first_of;  // the first channel that uses each operator
    for (int c = 0; c < 3; ++c) {
        const auto same = std::find_if(first_of.begin(), first_of.end(), [&](int earlier) {
            return (rho.col(earlier) == rho.col(c)).all();
        });
        transport.channel[static_cast<std::size_t>(c)] = static_cast<int>(same - first_of.begin());
        if (same != first_of.end()) continue;
        first_of.push_back(c);
        const NeumannSeries series =
            truncated_series(transport.bounce, rho.col(c), tried, target.global, rule, progress);
        if (!is_finite(series.sum))
            throw InputError(
                "the operator gives back more light than it gets, so that its bounces have no sum: "
                "links are computed from too few samples; another --oracle-tolerance or --error, "
                "or the geometric oracle, helps");
        transport.indirect.push_back(
            to_operator(without_small_means(series.sum, rule, share_of_means * target.global)));
        transport.provenance.bounces = std::max(transport.provenance.bounces, series.bounces);
    }
}

}  // namespace lightwell
