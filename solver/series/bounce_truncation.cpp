#include "solver/series/bounce_truncation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/series/truncation.h"

namespace lightwell {

BounceTruncation::BounceTruncation(const RadianceSpace& space, const std::vector<bool>& closed,
                                   std::vector<Coefficient> coefficients, Eigen::ArrayXd weight)
    : space_(space), coefficients_(std::move(coefficients)), weight_(std::move(weight)) {
    uniform_ = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(space.functions()));
    for (const Element& element : space.elements())
        uniform_[element.first] = std::sqrt(element.area());
    wanted_ = Eigen::ArrayXd::Zero(uniform_.size());
    for (const Coefficient& c : coefficients_)
        respond(c, wanted_);
    for (std::size_t e = 0; e < space.elements().size(); ++e) {
        const Element& element = space.element(e);
        if (closed[e]) wanted_.segment(element.first + 1, element.functions() - 1) = 0;
    }
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
    std::vector<double> magnitudes;
    magnitudes.reserve(coefficients_.size());
    for (const Coefficient& c : coefficients_)
        magnitudes.push_back(magnitude(c));
    return threshold_for_budget(std::move(magnitudes), budget);
}

void BounceTruncation::forget_below(double threshold) {
    coefficients_.erase(
        std::remove_if(coefficients_.begin(), coefficients_.end(),
                       [&](const Coefficient& c) { return !is_kept(c, threshold); }),
        coefficients_.end());
    coefficients_.shrink_to_fit();
}

SymmetricOperator BounceTruncation::at(double threshold) const {
    Eigen::ArrayXd lost = wanted_;
    Eigen::ArrayXd response = Eigen::ArrayXd::Zero(lost.size());
    Eigen::ArrayXd carried = Eigen::ArrayXd::Zero(lost.size());
    const auto detail_of = [&](const Coefficient& c) {
        return uniform_[c.column] != 0 ? c.row : c.column;
    };
    for (const Coefficient& c : coefficients_) {
        if (!is_kept(c, threshold)) continue;
        respond(c, response);
        if ((uniform_[c.row] != 0) == (uniform_[c.column] != 0)) continue;
        carried[detail_of(c)] += static_cast<double>(c.value) * static_cast<double>(c.value) *
                                 std::max(uniform_[c.row], uniform_[c.column]);
    }
    lost -= response;

    SymmetricOperator result;
    TransportOperator& upper = result.upper;
    upper.size = space_.functions();
    upper.column_start.assign(1, 0);
    std::size_t next = 0;
    for (std::uint32_t column = 0; column < upper.size; ++column) {
        for (; next < coefficients_.size() && coefficients_[next].column == column; ++next) {
            const Coefficient& c = coefficients_[next];
            if (!is_kept(c, threshold)) continue;
            double value = static_cast<double>(c.value);
            if ((uniform_[c.row] != 0) != (uniform_[c.column] != 0)) {
                const std::uint32_t detail = detail_of(c);
                if (carried[detail] > 0) value += lost[detail] * value * value / carried[detail];
            }
            upper.row.push_back(c.row);
            upper.value.push_back(static_cast<float>(value));
        }
        upper.column_start.push_back(upper.value.size());
    }
    return result;
}

}  // namespace lightwell
