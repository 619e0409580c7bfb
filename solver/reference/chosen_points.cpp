#include "solver/reference/chosen_points.h"

#include <cstddef>

namespace lightwell {

namespace {

/// How much oftener than by visibility alone each point is to be chosen.
std::vector<double> preferences(const ShownPoints& shown) {
    double mean = 0, weights = 0;
    for (std::size_t i = 0; i < shown.value.size(); ++i) {
        mean += shown.weight[i] * shown.value[i].square().sum();
        weights += shown.weight[i];
    }
    if (weights > 0) mean /= weights;
    std::vector<double> preferences;
    for (const Rgb& value : shown.value)
        preferences.push_back(mean > 0 ? 0.5 + 0.5 * value.square().sum() / mean : 1);
    return preferences;
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

ChosenPoints chosen_points(const CandidatePoints& candidates, int count, double offset) {
    const ShownPoints& shown = candidates.shown;
    const std::vector<double> preference = preferences(shown);
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
