#include "solver/transport/closure.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

namespace {

/// A density per cell position of every element; links of coarse cells count for all finer cells
/// below.
using Density = std::vector<std::vector<double>>;

Density zeros(const std::vector<Element>& elements) {
    Density density(elements.size());
    for (std::size_t e = 0; e < elements.size(); ++e)
        density[e].assign(elements[e].space.tree().positions(), 0.0);
    return density;
}

/// What a coarse cell exchanges, each of its parts does.
void spread_downwards(const std::vector<Element>& elements, Density& density) {
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const CellTree& tree = elements[e].space.tree();
        for (std::uint32_t p = 1; p < tree.positions(); ++p)
            density[e][p] += density[e][tree.position(tree.parent(tree.at(p)))];
    }
}

/// Each link's exchange area over the area of either of its cells, of the links that are sampled or
/// of those that are not.
Density link_density(const std::vector<Element>& elements, const std::vector<PairLinks>& pairs,
                     bool sampled) {
    Density density = zeros(elements);
    for (const PairLinks& pair : pairs) {
        const HaarBasis& x = elements[pair.receiver].space;
        const HaarBasis& y = elements[pair.sender].space;
        for (const LinkValue& link : pair.links) {
            if (link.sampled != sampled) continue;
            density[pair.receiver][link.receiver] += link.exchange / x.area_at(link.receiver);
            density[pair.sender][link.sender] += link.exchange / y.area_at(link.sender);
        }
    }
    spread_downwards(elements, density);
    return density;
}

/// Replaces the values of coarse cells by the mean of the finest cells below.
void average_upwards(const std::vector<Element>& elements, Density& density) {
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const HaarBasis& basis = elements[e].space;
        const CellTree& tree = basis.tree();
        const std::uint32_t first_finest = tree.positions() - tree.functions();
        for (std::uint32_t p = first_finest; p-- > 0;) {
            const Cell cell = tree.at(p);
            double sum = 0;
            for (std::uint32_t c = 0; c < tree.children(cell.level); ++c) {
                const Cell child = tree.child(cell, c);
                sum += basis.area(child) * density[e][tree.position(child)];
            }
            density[e][p] = sum / basis.area(cell);
        }
    }
}

/// Row sums of sides that are not closed may exceed one by this much: taking away every excess, and
/// adding to no deficit, would darken the scene.
constexpr double excess_by_chance = 0.1;

/// What a cell lacks to a full hemisphere. Nothing can be said of cells that are buried; and where
/// something may escape, only that more than a full hemisphere is too much.
class Deficits {
  public:
    Deficits(const std::vector<Element>& elements, const std::vector<bool>& closed,
             const Density& exact, const std::vector<PairLinks>& pairs)
        : elements_(elements), closed_(closed), sampled_(link_density(elements, pairs, true)) {
        for (std::size_t e = 0; e < elements.size(); ++e) {
            const CellTree& tree = elements[e].space.tree();
            const std::uint32_t first = tree.positions() - tree.functions();
            missing_.emplace_back(tree.positions(), 0.0);
            for (std::uint32_t p = first; p < tree.positions(); ++p) {
                const double lacks = 1 - exact[e][p] - sampled_[e][p];
                const bool is_buried =
                    !elements[e].open.empty() && elements[e].open[p - first] == 0;
                if (!is_buried)
                    missing_[e][p] = closed[e] ? lacks : std::min(0.0, lacks + excess_by_chance);
            }
        }
        average_upwards(elements, missing_);
        average_upwards(elements, sampled_);
    }

    /// By how much of themselves the sampled links of a cell should change.
    double gain(std::uint32_t e, std::uint32_t position) const {
        return sampled_[e][position] > 0 ? missing_[e][position] / sampled_[e][position] : 0;
    }

    /// Largest deficit over the finest cells that have sampled links to mend it with.
    double largest() const {
        double largest = 0;
        for_finest([&](std::size_t e, std::uint32_t p) {
            if (sampled_[e][p] > 0) largest = std::max(largest, std::abs(missing_[e][p]));
        });
        return largest;
    }

    /// Root mean square over the area of closed elements.
    double rms() const {
        double squares = 0, area = 0;
        for_finest([&](std::size_t e, std::uint32_t p) {
            if (!closed_[e]) return;
            const double a = elements_[e].space.area(elements_[e].space.tree().at(p));
            squares += a * missing_[e][p] * missing_[e][p];
            area += a;
        });
        return area > 0 ? std::sqrt(squares / area) : 0;
    }

  private:
    template <typename Visit>
    void for_finest(Visit visit) const {
        for (std::size_t e = 0; e < elements_.size(); ++e) {
            const CellTree& tree = elements_[e].space.tree();
            for (std::uint32_t p = tree.positions() - tree.functions(); p < tree.positions(); ++p)
                visit(e, p);
        }
    }

    const std::vector<Element>& elements_;
    const std::vector<bool>& closed_;
    Density sampled_;
    Density missing_;
};

/// Exchange areas of the sampled links, in the order of pairs and links.
std::vector<double> sampled_exchange(const std::vector<PairLinks>& pairs) {
    std::size_t count = 0;
    for (const PairLinks& pair : pairs)
        for (const LinkValue& link : pair.links)
            count += link.sampled ? 1 : 0;
    std::vector<double> exchange;
    exchange.reserve(count);
    for (const PairLinks& pair : pairs)
        for (const LinkValue& link : pair.links)
            if (link.sampled) exchange.push_back(link.exchange);
    return exchange;
}

}  // namespace

ClosureReport close_links(const std::vector<Element>& elements, const std::vector<bool>& closed,
                          const ClosureOptions& options, std::vector<PairLinks>& pairs,
                          const Progress& progress) {
    const std::vector<double> sampled = sampled_exchange(pairs);
    const Density exact = link_density(elements, pairs, false);
    ClosureReport report;
    for (;; ++report.sweeps) {
        progress.check();
        const Deficits deficits(elements, closed, exact, pairs);
        if (report.sweeps == 0) report.deficit_before = deficits.rms();
        report.deficit_after = deficits.rms();
        if (report.sweeps == options.sweeps || deficits.largest() <= options.target) return report;
        std::size_t next = 0;
        for (PairLinks& pair : pairs) {
            for (LinkValue& link : pair.links) {
                if (!link.sampled) continue;
                const double wanted = 0.5 * (deficits.gain(pair.receiver, link.receiver) +
                                             deficits.gain(pair.sender, link.sender));
                const double original = sampled[next++];
                link.exchange =
                    std::clamp(link.exchange * (1 + std::clamp(wanted, -0.5, 0.5)),
                               original / options.most_change, original * options.most_change);
            }
        }
    }
}

std::vector<std::vector<double>> row_sums(const std::vector<Element>& elements,
                                          const std::vector<PairLinks>& pairs) {
    Density total = link_density(elements, pairs, false);
    const Density sampled = link_density(elements, pairs, true);
    for (std::size_t e = 0; e < elements.size(); ++e) {
        for (std::size_t p = 0; p < total[e].size(); ++p)
            total[e][p] += sampled[e][p];
        const std::uint32_t finest = elements[e].space.tree().functions();
        total[e].erase(total[e].begin(), total[e].end() - static_cast<std::ptrdiff_t>(finest));
    }
    return total;
}

}  // namespace lightwell
