#include "solver/reference/chosen_points.h"

#include <algorithm>
#include <cstddef>

namespace lightwell {

namespace {

/// Values over their weighted mean; all one where that is 0.
std::vector<double> over_mean(std::vector<double> values, const std::vector<double>& weight) {
    double mean = 0, weights = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        mean += weight[i] * values[i];
        weights += weight[i];
    }
    if (weights > 0) mean /= weights;
    for (double& value : values)
        value = mean > 0 ? value / mean : 1;
    return values;
}

std::vector<double> squares(const std::vector<Rgb>& values) {
    std::vector<double> result;
    for (const Rgb& value : values)
        result.push_back(value.square().sum());
    return result;
}

std::vector<Rgb> differences(const CandidatePoints& candidates) {
    std::vector<Rgb> result;
    for (std::size_t i = 0; i < candidates.otherwise.size(); ++i)
        result.push_back(candidates.shown.value[i] - candidates.otherwise[i]);
    return result;
}

/// How often places that are shown dark are to be chosen. They are few where a narrow gap is taken
/// for dark, and all light that gets in is missing then: in a Cornell box with a lamp 1 cm below
/// the ceiling such rims are half of the squared error on a hundredth of the surface, which lamps
/// judged at 64 places have or have not. In a building, the other rooms are dark.
class DarkPlaces {
  public:
    /// @param bright  squares of the light shown, over their weighted mean
    DarkPlaces(const std::vector<double>& bright, const std::vector<double>& weight) {
        double dark = 0, all = 0;
        for (std::size_t i = 0; i < bright.size(); ++i) {
            all += weight[i];
            if (is_dark(bright[i])) dark += weight[i];
        }
        constexpr double share = 0.2, most = 8;
        if (dark > 0) preference_ = std::min(most, share * all / dark);
    }

    double at_least(double bright, double preference) const {
        return is_dark(bright) ? std::max(preference, preference_) : preference;
    }

  private:
    static bool is_dark(double bright) {
        constexpr double hundredth_squared = 1e-4;
        return bright < hundredth_squared;
    }

    double preference_ = 0;
};

/// How much oftener than by visibility alone each point is to be chosen; about one on average.
std::vector<double> preferences(const CandidatePoints& candidates) {
    const std::vector<double>& weight = candidates.shown.weight;
    const std::vector<double> bright = over_mean(squares(candidates.shown.value), weight);
    const DarkPlaces dark(bright, weight);
    const bool two_ways = !candidates.otherwise.empty();
    const std::vector<double> unsure =
        two_ways ? over_mean(squares(differences(candidates)), weight) : std::vector<double>{};
    std::vector<double> preference;
    for (std::size_t i = 0; i < bright.size(); ++i)
        preference.push_back(dark.at_least(
            bright[i], two_ways ? 0.4 + 0.3 * bright[i] + 0.3 * unsure[i] : 0.5 + 0.5 * bright[i]));
    return preference;
}

/// `count` numbers, each with a chance proportional to its weight.
std::vector<std::size_t> drawn(const std::vector<double>& weight, int count, double offset) {
    double all = 0;
    for (const double one : weight)
        all += one;
    std::vector<std::size_t> numbers;
    if (!(all > 0)) return numbers;
    double covered = 0;
    for (std::size_t i = 0; i < weight.size(); ++i) {
        covered += weight[i];
        while (numbers.size() < static_cast<std::size_t>(count) && weight[i] > 0 &&
               (static_cast<double>(numbers.size()) + offset) * all < covered * count)
            numbers.push_back(i);
    }
    return numbers;
}

}  // namespace

double relative_difference(const CandidatePoints& candidates) {
    const std::vector<double> difference = squares(differences(candidates));
    const std::vector<double> size = squares(candidates.shown.value);
    double differing = 0, all = 0;
    for (std::size_t i = 0; i < difference.size(); ++i) {
        differing += candidates.shown.weight[i] * difference[i];
        all += candidates.shown.weight[i] * size[i];
    }
    return all > 0 ? differing / all : 0;
}

ChosenPoints chosen_points(const CandidatePoints& candidates, int count, double offset) {
    const ShownPoints& shown = candidates.shown;
    const std::vector<double> preference = preferences(candidates);
    std::vector<double> chance = shown.weight;
    for (std::size_t i = 0; i < chance.size(); ++i)
        chance[i] *= preference[i];
    ChosenPoints chosen;
    for (const std::size_t i : drawn(chance, count, offset)) {
        chosen.points.push_back(candidates.points[i]);
        chosen.visible.push_back(shown.weight[i]);
        chosen.shown.value.push_back(shown.value[i]);
        chosen.shown.weight.push_back(1 / preference[i]);
    }
    return chosen;
}

}  // namespace lightwell
