#include "solver/transport/directed_links.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <tbb/parallel_for.h>

#include "radiance4d/basis/angular_shares.h"
#include "radiance4d/basis/direction_map.h"
#include "solver/transport/even_points.h"

namespace lightwell {

namespace {

bool is_directed(const Element& element) {
    return element.angle.levels() > 0;
}

std::uint32_t finest_position(const CellTree& tree, std::uint32_t cell) {
    return tree.position({tree.levels(), cell});
}

Vec2 in_rect(const ParameterRect& r, double a, double b) {
    return {r.u0 + a * (r.u1 - r.u0), r.v0 + b * (r.v1 - r.v0)};
}

/// Links by the elements they join.
using LinksByPair = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<DirectedLink>>;

/// Casts the rays of one element.
class RayLinks {
  public:
    RayLinks(const std::vector<Element>& elements, const Visibility& visibility,
             const DirectedLinkOptions& options)
        : elements_(elements), visibility_(visibility), rays_(options.rays) {
        for (std::size_t e = 0; e < elements.size(); ++e) {
            by_side_[{elements[e].quad, elements[e].front}] = static_cast<std::uint32_t>(e);
            frame_.push_back(local_frame(elements[e].geometry));
        }
    }

    LinksByPair from(std::uint32_t e) const {
        LinksByPair found;
        const CellTree& space = elements_[e].space.tree();
        const std::uint32_t angles = elements_[e].angle.functions();
        for (std::uint32_t cell = 0; cell < space.functions(); ++cell)
            for (std::uint32_t angle = 0; angle < angles; ++angle)
                cast(e, cell, angle, found);
        return found;
    }

  private:
    void cast(std::uint32_t e, std::uint32_t cell, std::uint32_t angle, LinksByPair& found) const {
        const Element& x = elements_[e];
        const CellTree& space = x.space.tree();
        const ParameterRect at = space.rect({space.levels(), cell});
        const ParameterRect through = x.angle.rect({x.angle.levels(), angle});
        const double part = x.space.area({space.levels(), cell}) / x.angle.functions() / rays_;
        EvenPoints4 points(std::uint64_t{cell} * x.angle.functions() + angle);
        for (int k = 0; k < rays_; ++k) {
            std::array<double, 4> point = points.next();
            Vec2 uv = in_rect(at, point[0], point[1]);
            // What is buried sees nothing: another point of the cell stands for it.
            constexpr int most_attempts = 64;
            for (int i = 0; i < most_attempts && !x.is_sample_open(uv[0], uv[1]); ++i) {
                point = points.next();
                uv = in_rect(at, point[0], point[1]);
            }
            const Vec3 origin = x.geometry.point(uv[0], uv[1]);
            const Vec3 direction =
                frame_[e] * direction_from_square(in_rect(through, point[2], point[3]));
            const Hit hit = visibility_.nearest(origin, x.quad, direction);
            if (!hit) continue;
            const auto met = by_side_.find({hit.quad, hit.front});
            if (met == by_side_.end()) continue;
            record(end_at(e, origin, direction),
                   end_at(met->second, origin + hit.distance * direction, -direction), part, found);
        }
    }

    /// One end of a ray: element, spatial position, and angular cells.
    struct End {
        std::uint32_t element, space;
        std::array<AngularShare, 4> angles;
    };

    End end_at(std::uint32_t e, const Vec3& point, const Vec3& direction) const {
        const Element& y = elements_[e];
        const CellTree& space = y.space.tree();
        const Vec2 at = y.geometry.parameters(point);
        return {e, finest_position(space, space.finest_around(at[0], at[1])),
                angular_shares(y.angle, y.angle.levels(), frame_[e].transpose() * direction)};
    }

    void record(const End& x, const End& y, double exchange, LinksByPair& found) const {
        const bool both = is_directed(elements_[x.element]) && is_directed(elements_[y.element]);
        const End& receiver = x.element < y.element ? x : y;
        const End& sender = x.element < y.element ? y : x;
        const auto position = [this](const End& end, const AngularShare& share) {
            return finest_position(elements_[end.element].angle, share.cell);
        };
        std::vector<DirectedLink>& links = found[{receiver.element, sender.element}];
        for (const AngularShare& i : receiver.angles)
            for (const AngularShare& j : sender.angles)
                if (i.share * j.share > 0)
                    links.push_back({receiver.space, position(receiver, i), sender.space,
                                     position(sender, j),
                                     i.share * j.share * (both ? exchange / 2 : exchange), true});
    }

    const std::vector<Element>& elements_;
    const Visibility& visibility_;
    int rays_;
    std::map<std::pair<int, bool>, std::uint32_t> by_side_;
    std::vector<Eigen::Matrix3d> frame_;
};

/// Joins the links that share all supports; the order is by supports.
void join_equal(std::vector<DirectedLink>& links) {
    const auto supports = [](const DirectedLink& link) {
        return std::tie(link.receiver, link.receiver_angle, link.sender, link.sender_angle);
    };
    std::stable_sort(links.begin(), links.end(), [&](const DirectedLink& a, const DirectedLink& b) {
        return supports(a) < supports(b);
    });
    std::size_t last = 0;
    for (std::size_t k = 1; k < links.size(); ++k) {
        if (supports(links[k]) == supports(links[last]))
            links[last].exchange += links[k].exchange;
        else
            links[++last] = links[k];
    }
    links.resize(std::min(links.size(), last + 1));
}

/// The finest cells below a cell: a run of numbers.
struct Run {
    std::uint32_t first = 0, end = 0;
};

Run finest_below(const CellTree& tree, std::uint32_t position) {
    const Cell cell = tree.at(position);
    const std::uint32_t count = tree.functions() / tree.cells(cell.level);
    return {cell.index * count, (cell.index + 1) * count};
}

/// How full every direction of every finest cell is, by element: exchange over |X| |A|, of the
/// links that are given, which stay, and of those that rays decided.
class Fullness {
  public:
    Fullness(const std::vector<Element>& elements, const std::vector<bool>& closed,
             const std::vector<DirectedPair>& pairs)
        : elements_(elements), closed_(closed) {
        for (const Element& element : elements) {
            given_.emplace_back(element.functions(), 0.0);
            sampled_.emplace_back(element.functions(), 0.0);
        }
        add(pairs, false, given_);
    }

    /// Counts the sampled links anew.
    void sample(const std::vector<DirectedPair>& pairs) {
        for (std::vector<double>& share : sampled_)
            std::fill(share.begin(), share.end(), 0.0);
        add(pairs, true, sampled_);
    }

    /// By how much the sampled links of a support should grow: on the mean over its finest parts.
    double gain(std::uint32_t e, std::uint32_t space, std::uint32_t angle) const {
        if (!closed_[e]) return 1;
        double wanted = 0, there = 0;
        for_finest(elements_[e], space, angle, [&](std::size_t at, double area) {
            wanted += area * (1 - given_[e][at]);
            there += area * sampled_[e][at];
        });
        return wanted > 0 && there > 0 ? wanted / there : 1;
    }

    double rms() const {
        double squares = 0, area = 0;
        for (std::size_t e = 0; e < elements_.size(); ++e) {
            if (!closed_[e]) continue;
            const Element& element = elements_[e];
            const std::uint32_t angles = element.angle.functions();
            for (std::size_t k = 0; k < given_[e].size(); ++k) {
                const auto cell = static_cast<std::uint32_t>(k / angles);
                const double weight =
                    element.space.area({element.space.tree().levels(), cell}) / angles;
                squares += weight * std::pow(given_[e][k] + sampled_[e][k] - 1, 2);
                area += weight;
            }
        }
        return area > 0 ? std::sqrt(squares / area) : 0;
    }

  private:
    using Share = std::vector<std::vector<double>>;  // finest cell * angular cells + angular cell

    /// Calls `f` with the place of every finest direction of a support in its list, and its area.
    template <typename F>
    static void for_finest(const Element& element, std::uint32_t space, std::uint32_t angle,
                           const F& f) {
        const Run cells = finest_below(element.space.tree(), space);
        const Run angles = finest_below(element.angle, angle);
        for (std::uint32_t m = cells.first; m < cells.end; ++m) {
            const double area = element.space.area({element.space.tree().levels(), m});
            for (std::uint32_t a = angles.first; a < angles.end; ++a)
                f(std::size_t{m} * element.angle.functions() + a, area);
        }
    }

    void add(const std::vector<DirectedPair>& pairs, bool sampled, Share& to) const {
        for (const DirectedPair& pair : pairs)
            for (const DirectedLink& link : pair.links) {
                if (link.sampled != sampled) continue;
                add(pair.receiver, link.receiver, link.receiver_angle, link, to[pair.receiver]);
                add(pair.sender, link.sender, link.sender_angle, link, to[pair.sender]);
            }
    }

    void add(std::uint32_t e, std::uint32_t space, std::uint32_t angle, const DirectedLink& link,
             std::vector<double>& share) const {
        const Element& element = elements_[e];
        const Run angles = finest_below(element.angle, angle);
        const double density = link.exchange * element.angle.functions() /
                               (angles.end - angles.first) / element.space.area_at(space);
        for_finest(element, space, angle, [&](std::size_t at, double) { share[at] += density; });
    }

    const std::vector<Element>& elements_;
    const std::vector<bool>& closed_;
    Share given_, sampled_;
};

}  // namespace

std::vector<DirectedPair> directed_links(const std::vector<Element>& elements,
                                         const std::vector<PairLinks>& given,
                                         const Visibility& visibility,
                                         const DirectedLinkOptions& options,
                                         const Progress& progress, OracleCost& cost) {
    const RayLinks rays(elements, visibility, options);
    std::vector<LinksByPair> by_element(elements.size());
    tbb::parallel_for(std::size_t{0}, elements.size(), [&](std::size_t e) {
        progress.check();
        if (is_directed(elements[e])) by_element[e] = rays.from(static_cast<std::uint32_t>(e));
    });
    LinksByPair all;
    for (std::size_t e = 0; e < elements.size(); ++e) {
        if (is_directed(elements[e]))
            cost.rays +=
                std::uint64_t{elements[e].functions()} * static_cast<std::uint64_t>(options.rays);
        for (auto& [pair, links] : by_element[e]) {
            std::vector<DirectedLink>& joined = all[pair];
            joined.insert(joined.end(), links.begin(), links.end());
        }
        by_element[e].clear();
    }
    for (const PairLinks& pair : given) {
        if (is_directed(elements[pair.receiver]) || is_directed(elements[pair.sender])) continue;
        std::vector<DirectedLink>& links = all[{pair.receiver, pair.sender}];
        for (const LinkValue& link : pair.links)
            links.push_back({link.receiver, 0, link.sender, 0, link.exchange, false});
    }
    std::vector<DirectedPair> result;
    for (auto& [pair, links] : all) {
        join_equal(links);
        result.push_back({pair.first, pair.second, std::move(links)});
    }
    return result;
}

double close_directions(const std::vector<Element>& elements, const std::vector<bool>& closed,
                        std::vector<DirectedPair>& pairs) {
    constexpr int sweeps = 48;
    constexpr double good_enough = 2e-4, most_change = 2;
    std::vector<std::vector<double>> original;
    for (const DirectedPair& pair : pairs) {
        original.emplace_back();
        for (const DirectedLink& link : pair.links)
            original.back().push_back(link.exchange);
    }
    double before = 0;
    Fullness fullness(elements, closed, pairs);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        fullness.sample(pairs);
        if (sweep == 0) before = fullness.rms();
        if (fullness.rms() < good_enough) break;
        tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t p) {
            for (std::size_t k = 0; k < pairs[p].links.size(); ++k) {
                DirectedLink& link = pairs[p].links[k];
                if (!link.sampled) continue;
                const double wanted =
                    fullness.gain(pairs[p].receiver, link.receiver, link.receiver_angle) *
                    fullness.gain(pairs[p].sender, link.sender, link.sender_angle);
                link.exchange =
                    std::clamp(link.exchange * std::sqrt(wanted), original[p][k] / most_change,
                               original[p][k] * most_change);
            }
        });
    }
    return before;
}

}  // namespace lightwell
