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

/// Adds each link's exchange area to both of its cells, divided by the cell's area.
Density link_density(const std::vector<Element>& elements, const std::vector<PairLinks>& pairs,
                     bool sampled_only) {
    Density density = zeros(elements);
    for (const PairLinks& pair : pairs) {
        const HaarBasis& x = elements[pair.receiver].space;
        const HaarBasis& y = elements[pair.sender].space;
        for (const LinkValue& link : pair.links) {
            if (sampled_only && !link.sampled) continue;
            density[pair.receiver][link.receiver] +=
                link.exchange / x.area(x.tree().at(link.receiver));
            density[pair.sender][link.sender] += link.exchange / y.area(y.tree().at(link.sender));
        }
    }
    // What a coarse cell exchanges, each of its parts does.
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const CellTree& tree = elements[e].space.tree();
        for (std::uint32_t p = 1; p < tree.positions(); ++p)
            density[e][p] += density[e][tree.position(tree.parent(tree.at(p)))];
    }
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

/// Largest and rms deficit over the finest cells of closed elements that have sampled links to mend
/// it with.
struct Deficit {
    double largest = 0;
    double rms = 0;
};

Deficit measure(const std::vector<Element>& elements, const std::vector<bool>& closed,
                const Density& total, const Density& sampled) {
    Deficit deficit;
    double area = 0;
    for (std::size_t e = 0; e < elements.size(); ++e) {
        if (!closed[e]) continue;
        const HaarBasis& basis = elements[e].space;
        const std::uint32_t first = basis.tree().positions() - basis.tree().functions();
        for (std::uint32_t p = first; p < basis.tree().positions(); ++p) {
            const double missing = 1 - total[e][p];
            const double a = basis.area(basis.tree().at(p));
            deficit.rms += a * missing * missing;
            area += a;
            if (sampled[e][p] > 0) deficit.largest = std::max(deficit.largest, std::abs(missing));
        }
    }
    if (area > 0) deficit.rms = std::sqrt(deficit.rms / area);
    return deficit;
}

}  // namespace

ClosureReport close_links(const std::vector<Element>& elements, const std::vector<bool>& closed,
                          const ClosureOptions& options, std::vector<PairLinks>& pairs) {
    ClosureReport report;
    for (;; ++report.sweeps) {
        Density total = link_density(elements, pairs, false);
        Density sampled = link_density(elements, pairs, true);
        const Deficit deficit = measure(elements, closed, total, sampled);
        if (report.sweeps == 0) report.deficit_before = deficit.rms;
        report.deficit_after = deficit.rms;
        if (report.sweeps == options.sweeps || deficit.largest <= options.target) return report;

        average_upwards(elements, total);
        average_upwards(elements, sampled);
        const auto gain = [&](std::uint32_t e, std::uint32_t position) {
            if (!closed[e] || !(sampled[e][position] > 0)) return 0.0;
            return (1 - total[e][position]) / sampled[e][position];
        };
        for (PairLinks& pair : pairs) {
            const int ends = (closed[pair.receiver] ? 1 : 0) + (closed[pair.sender] ? 1 : 0);
            if (ends == 0) continue;
            for (LinkValue& link : pair.links) {
                if (!link.sampled) continue;
                const double wanted =
                    (gain(pair.receiver, link.receiver) + gain(pair.sender, link.sender)) / ends;
                link.exchange *= 1 + std::clamp(wanted, -options.most_change, options.most_change);
            }
        }
    }
}

std::vector<std::vector<double>> row_sums(const std::vector<Element>& elements,
                                          const std::vector<PairLinks>& pairs) {
    Density total = link_density(elements, pairs, false);
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const std::uint32_t finest = elements[e].space.tree().functions();
        total[e].erase(total[e].begin(), total[e].end() - static_cast<std::ptrdiff_t>(finest));
    }
    return total;
}

}  // namespace lightwell
