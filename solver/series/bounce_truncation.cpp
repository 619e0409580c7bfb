#include "solver/series/bounce_truncation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "solver/series/truncation.h"

namespace lightwell {

BounceTruncation::BounceTruncation(const RadianceSpace& space, const std::vector<bool>& closed,
                                   std::vector<Coefficient> coefficients, Eigen::ArrayXd weight)
    : space_(space), coefficients_(std::move(coefficients)), weight_(std::move(weight)) {
    uniform_ = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(space.functions()));
    for (const Element& element : space.elements())
        uniform_[element.first] = std::sqrt(element.area());
    find_places();
    wanted_ = Eigen::ArrayXd::Zero(uniform_.size());
    for (const std::size_t k : of_uniform_)
        respond(coefficients_[k], wanted_);
    for (std::size_t e = 0; e < space.elements().size(); ++e) {
        const Element& element = space.element(e);
        if (closed[e]) wanted_.segment(element.first + 1, element.functions() - 1) = 0;
    }
}

void BounceTruncation::find_places() {
    column_start_.assign(static_cast<std::size_t>(uniform_.size()) + 1, 0);
    of_uniform_.clear();
    for (std::size_t k = 0; k < coefficients_.size(); ++k) {
        const Coefficient& c = coefficients_[k];
        ++column_start_[std::size_t{c.column} + 1];
        if (uniform_[c.row] != 0 || uniform_[c.column] != 0) of_uniform_.push_back(k);
    }
    std::partial_sum(column_start_.begin(), column_start_.end(), column_start_.begin());
}

void BounceTruncation::weigh(Eigen::ArrayXd weight, Eigen::ArrayXd visibility) {
    weight_ = std::move(weight);
    visibility_ = std::move(visibility);
}

double BounceTruncation::magnitude(const Coefficient& c) const {
    const double size = std::abs(static_cast<double>(c.value));
    if (visibility_.size() == 0) return size * std::max(weight_[c.row], weight_[c.column]);
    return size *
           std::max(visibility_[c.row] * weight_[c.column], weight_[c.row] * visibility_[c.column]);
}

bool BounceTruncation::joins_means(const Coefficient& c) const {
    return uniform_[c.row] != 0 && uniform_[c.column] != 0;
}

bool BounceTruncation::is_kept(const Coefficient& c, double threshold) const {
    return magnitude(c) >= threshold || joins_means(c);
}

void BounceTruncation::respond(const Coefficient& c, Eigen::ArrayXd& response) const {
    response[c.row] += static_cast<double>(c.value) * uniform_[c.column];
    response[c.column] += static_cast<double>(c.value) * uniform_[c.row];
}

double BounceTruncation::threshold_for(double budget) const {
    std::vector<double> magnitudes(coefficients_.size());
    tbb::parallel_for(std::size_t{0}, coefficients_.size(),
                      [&](std::size_t k) { magnitudes[k] = magnitude(coefficients_[k]); });
    return threshold_for_budget(std::move(magnitudes), budget);
}

void BounceTruncation::forget_below(double threshold) {
    coefficients_.erase(
        std::remove_if(coefficients_.begin(), coefficients_.end(),
                       [&](const Coefficient& c) { return !is_kept(c, threshold); }),
        coefficients_.end());
    coefficients_.shrink_to_fit();
    find_places();
}

SymmetricOperator BounceTruncation::at(double threshold) const {
    Eigen::ArrayXd lost = wanted_;
    Eigen::ArrayXd response = Eigen::ArrayXd::Zero(lost.size());
    Eigen::ArrayXd carried = Eigen::ArrayXd::Zero(lost.size());
    const auto joins_mean_and_detail = [&](const Coefficient& c) {
        return (uniform_[c.row] != 0) != (uniform_[c.column] != 0);
    };
    const auto detail_of = [&](const Coefficient& c) {
        return uniform_[c.column] != 0 ? c.row : c.column;
    };
    for (const std::size_t k : of_uniform_) {
        const Coefficient& c = coefficients_[k];
        if (!is_kept(c, threshold)) continue;
        respond(c, response);
        if (joins_mean_and_detail(c))
            carried[detail_of(c)] += static_cast<double>(c.value) * static_cast<double>(c.value) *
                                     std::max(uniform_[c.row], uniform_[c.column]);
    }
    lost -= response;
    const auto corrected = [&](const Coefficient& c) {
        double value = static_cast<double>(c.value);
        if (joins_mean_and_detail(c)) {
            const std::uint32_t detail = detail_of(c);
            if (carried[detail] > 0) value += lost[detail] * value * value / carried[detail];
        }
        return static_cast<float>(value);
    };

    SymmetricOperator result;
    TransportOperator& upper = result.upper;
    upper.size = space_.functions();
    upper.column_start.assign(std::size_t{upper.size} + 1, 0);
    const auto for_each_kept = [&](const auto& act) {
        tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, upper.size), [&](const auto& range) {
            for (std::size_t k = column_start_[range.begin()]; k < column_start_[range.end()]; ++k)
                if (is_kept(coefficients_[k], threshold)) act(coefficients_[k]);
        });
    };
    for_each_kept([&](const Coefficient& c) { ++upper.column_start[std::size_t{c.column} + 1]; });
    std::partial_sum(upper.column_start.begin(), upper.column_start.end(),
                     upper.column_start.begin());
    upper.row.resize(upper.column_start.back());
    upper.value.resize(upper.column_start.back());
    std::vector<std::uint64_t> next(upper.column_start.begin(), upper.column_start.end() - 1);
    for_each_kept([&](const Coefficient& c) {
        const std::uint64_t at = next[c.column]++;
        upper.row[at] = c.row;
        upper.value[at] = corrected(c);
    });
    return result;
}

}  // namespace lightwell
