#include "runtime/propagation/incremental_update.h"

#include <algorithm>
#include <array>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

/// L1 norm of all changes of a band, relative to its light, after which it is multiplied anew: each
/// leaves a rounding error of 6e-8 of itself.
constexpr double most_changes = 20;

float magnitude(const Packed& amount) {
    return amount.abs().sum();
}

}  // namespace

IncrementalUpdate::IncrementalUpdate(const RadianceSpace& space,
                                     const GlobalPropagation& propagation)
    : propagation_(propagation) {
    const auto size = static_cast<Eigen::Index>(propagation.size());
    LIGHTWELL_CHECK_OP(propagation.size(), ==, space.functions());
    int bands = 1;
    band_.reserve(propagation.size());
    for (const Element& element : space.elements())
        for (std::uint32_t f = 0; f < element.functions(); ++f) {
            const CellTree& tree = element.space.tree();
            const int level = tree.level_of_function(f / element.angle.functions());
            band_.push_back(static_cast<std::uint8_t>(level));
            bands = std::max(bands, level + 1);
        }
    for (std::uint32_t j = 0; j < propagation.size(); ++j)
        if (propagation.energy()[j] > 0) columns_.push_back(j);
    indirect_ = represented_ = previous_ = change_ = PackedField::Zero(4, size);
    bands_.resize(static_cast<std::size_t>(bands));
    for (Band& band : bands_)
        band.light = indirect_;
    candidates_.reserve(columns_.size());
    chosen_.reserve(columns_.size());
}

UpdateReport IncrementalUpdate::update(const PackedField& direct, const UpdateOptions& options) {
    LIGHTWELL_CHECK_OP(direct.cols(), ==, indirect_.cols());
    LIGHTWELL_CHECK_OP(options.frames_to_rest, >=, 1);
    const bool moved = has_moved(direct);
    frames_at_rest_ = moved ? 0 : frames_at_rest_ + 1;
    if (moved) previous_ = direct;
    if (!moved && bands_are_stale_) return {};
    if (options.budget == 0) return renew(direct);

    UpdateReport report;
    decide_fresh_bands(direct, options.mode);
    for (std::size_t band = 0; band < bands_.size(); ++band)
        if (bands_[band].is_fresh) {
            begin_anew(band);
            ++report.fresh_bands;
        } else if (bands_[band].is_worn) {
            recompute(band);
        }
    sum_bands();
    bands_are_stale_ = false;
    collect_candidates(direct);
    if (!moved && candidates_.empty()) return renew(direct);
    const std::size_t count = allowed(options);
    report.coefficients = static_cast<std::uint32_t>(count);
    report.pending = static_cast<std::uint32_t>(candidates_.size() - count);
    report.changed = count > 0 || report.fresh_bands > 0;
    choose(count);
    multiply(direct);
    return report;
}

bool IncrementalUpdate::has_moved(const PackedField& direct) const {
    return std::any_of(columns_.begin(), columns_.end(),
                       [&](std::uint32_t j) { return (direct.col(j) != previous_.col(j)).any(); });
}

UpdateReport IncrementalUpdate::renew(const PackedField& direct) {
    UpdateReport report;
    represented_ = direct;
    propagation_.collect(direct, chosen_);
    indirect_.setZero();
    propagation_.add(chosen_, direct, indirect_);
    bands_are_stale_ = true;
    report.coefficients = static_cast<std::uint32_t>(chosen_.size());
    report.changed = true;
    return report;
}

void IncrementalUpdate::recompute(std::size_t band) {
    bands_[band].light.setZero();
    bands_[band].changes = 0;
    chosen_.clear();
    for (const std::uint32_t j : columns_)
        if (band_[j] == band && magnitude(represented_.col(j)) > 0) chosen_.push_back(j);
    propagation_.add(chosen_, represented_, bands_[band].light);
}

void IncrementalUpdate::sum_bands() {
    const auto is_anew = [](const Band& band) { return band.is_fresh || band.is_worn; };
    if (std::none_of(bands_.begin(), bands_.end(), is_anew)) return;
    indirect_.setZero();
    for (const Band& band : bands_)
        indirect_ += band.light;
}

void IncrementalUpdate::decide_fresh_bands(const PackedField& direct, UpdateMode mode) {
    std::array<double, 256> difference = {}, whole = {}, lit = {};
    for (const std::uint32_t j : columns_) {
        const std::size_t band = band_[j];
        difference[band] += static_cast<double>(magnitude(direct.col(j) - represented_.col(j)));
        whole[band] += static_cast<double>(magnitude(direct.col(j)));
        lit[band] += static_cast<double>(magnitude(represented_.col(j)));
    }
    for (std::size_t band = 0; band < bands_.size(); ++band) {
        const bool is_nearer_to_darkness = lit[band] > 0 && !(difference[band] < whole[band]);
        bands_[band].is_fresh =
            mode == UpdateMode::fresh || (mode == UpdateMode::per_band && is_nearer_to_darkness);
        bands_[band].is_worn = bands_are_stale_ || bands_[band].changes > most_changes * lit[band];
    }
}

void IncrementalUpdate::begin_anew(std::size_t band) {
    bands_[band].light.setZero();
    bands_[band].changes = 0;
    for (const std::uint32_t j : columns_)
        if (band_[j] == band) represented_.col(j).setZero();
}

void IncrementalUpdate::collect_candidates(const PackedField& direct) {
    candidates_.clear();
    for (const std::uint32_t j : columns_) {
        const float change = magnitude(direct.col(j) - represented_.col(j));
        if (change > 0) candidates_.push_back({j, change * propagation_.energy()[j]});
    }
}

std::size_t IncrementalUpdate::allowed(const UpdateOptions& options) const {
    const std::size_t all = candidates_.size();
    std::size_t count = std::min<std::size_t>(all, options.budget);
    if (frames_at_rest_ > 0 && options.mode != UpdateMode::fresh) {
        const auto left =
            static_cast<std::size_t>(std::max(1, options.frames_to_rest - frames_at_rest_ + 1));
        count = std::max(count, (all + left - 1) / left);
    }
    return count;
}

void IncrementalUpdate::choose(std::size_t count) {
    if (count == candidates_.size()) return;
    // Equal weights by column, so that the choice is the same everywhere.
    const auto heavier = [](const Candidate& a, const Candidate& b) {
        return a.weight > b.weight || (a.weight == b.weight && a.column < b.column);
    };
    std::nth_element(candidates_.begin(), candidates_.begin() + static_cast<std::ptrdiff_t>(count),
                     candidates_.end(), heavier);
    candidates_.resize(count);
    std::sort(candidates_.begin(), candidates_.end(),
              [](const Candidate& a, const Candidate& b) { return a.column < b.column; });
}

void IncrementalUpdate::multiply(const PackedField& direct) {
    for (std::size_t band = 0; band < bands_.size(); ++band) {
        chosen_.clear();
        for (const Candidate& candidate : candidates_) {
            const std::uint32_t j = candidate.column;
            if (band_[j] != band) continue;
            chosen_.push_back(j);
            change_.col(j) = direct.col(j) - represented_.col(j);
            represented_.col(j) = direct.col(j);
            bands_[band].changes += static_cast<double>(magnitude(change_.col(j)));
        }
        if (!chosen_.empty()) propagation_.add(chosen_, change_, bands_[band].light, &indirect_);
    }
}

}  // namespace lightwell
