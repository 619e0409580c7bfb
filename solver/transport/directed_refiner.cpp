#include "solver/transport/directed_refiner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "radiance4d/basis/angular_shares.h"
#include "radiance4d/basis/direction_map.h"
#include "solver/transport/even_points.h"
#include "solver/transport/kernel.h"
#include "solver/transport/largest_first.h"

namespace lightwell {

namespace {

bool is_directed(const Element& element) {
    return element.angle.levels() > 0;
}

std::vector<Cell> children_of(const CellTree& tree, const Cell& cell, bool refined) {
    if (!refined) return {cell};
    std::vector<Cell> children;
    for (std::uint32_t c = 0; c < tree.children(cell.level); ++c)
        children.push_back(tree.child(cell, c));
    return children;
}

/// The directed links of one pair of elements.
class PairDirections {
  public:
    PairDirections(const std::vector<Element>& elements, const std::vector<AngularDetail>& detail,
                   const PairLinks& pair, const DirectionalOracle& oracle,
                   const Visibility& visibility, const DirectedRefinerOptions& options)
        : receiver_(elements[pair.receiver]),
          sender_(elements[pair.sender]),
          receiver_detail_(detail[pair.receiver]),
          sender_detail_(detail[pair.sender]),
          receiver_frame_(local_frame(receiver_.geometry)),
          sender_frame_(local_frame(sender_.geometry)),
          oracle_(oracle),
          visibility_(visibility),
          options_(options) {
        result_.receiver = pair.receiver;
        result_.sender = pair.sender;
    }

    void visit(const Cell& x, const Cell& y, double exchange, bool sampled) {
        const DirectedCandidate link = candidate(x, y, exchange);
        const DirectedVerdict verdict = oracle_.judge(link);
        ++cost_.links_judged;
        if ((verdict.sub_domains & (receiver_space | sender_space)) != 0)
            divide(x, y, verdict.sub_domains, exchange, sampled);
        else
            tell_apart(link, verdict, sampled);
    }

    DirectedPair take() { return std::move(result_); }
    const OracleCost& cost() const { return cost_; }

  private:
    /// A pair of points that may see each other.
    struct Look {
        Vec3 x, y;
        double kernel = 0;
    };

    /// The angular cells of a look, and how much of the light between two cells takes that way.
    struct AnglesOfLook {
        std::uint32_t receiver = 0, sender = 0;
        double share = 0;
    };

    static DirectedEnd end(const Element& element, const AngularDetail& detail, const Cell& cell) {
        DirectedEnd result{&element, &detail, cell, element.cell(cell), 0};
        const Vec3 centre = result.outline.centre();
        for (const Vec3& corner : result.outline.vertex)
            result.reach = std::max(result.reach, (corner - centre).norm());
        return result;
    }

    DirectedCandidate candidate(const Cell& x, const Cell& y, double exchange) const {
        DirectedCandidate link{end(receiver_, receiver_detail_, x), end(sender_, sender_detail_, y),
                               exchange, 0};
        link.distance = (link.receiver.outline.centre() - link.sender.outline.centre()).norm();
        return link;
    }

    static Vec3 open_point(const Element& element, const ParameterRect& r, double a, double b,
                           bool& open) {
        const double u = r.u0 + a * (r.u1 - r.u0), v = r.v0 + b * (r.v1 - r.v0);
        open = element.is_sample_open(u, v);
        return element.geometry.point(u, v);
    }

    /// The kernel at evenly spread pairs of points of two cells; 0 where they are buried or do not
    /// see each other.
    std::vector<Look> looks(const Cell& x, const Cell& y, int count, bool sampled) {
        const ParameterRect of_x = receiver_.space.tree().rect(x);
        const ParameterRect of_y = sender_.space.tree().rect(y);
        EvenPoints4 points(std::uint64_t{receiver_.space.tree().position(x)} *
                               sender_.space.tree().positions() +
                           sender_.space.tree().position(y));
        std::vector<Look> result;
        for (int k = 0; k < count; ++k) {
            const std::array<double, 4>& at = points.next();
            bool x_open = true, y_open = true;
            Look look;
            look.x = open_point(receiver_, of_x, at[0], at[1], x_open);
            look.y = open_point(sender_, of_y, at[2], at[3], y_open);
            if (!x_open || !y_open) continue;
            look.kernel = kernel(look.x, receiver_frame_.col(2), look.y, sender_frame_.col(2));
            if (!(look.kernel > 0)) continue;
            if (sampled) {
                ++cost_.rays;
                if (visibility_.occluded(look.x, receiver_.quad, look.y, sender_.quad)) continue;
            }
            result.push_back(look);
        }
        return result;
    }

    /// Pairs of points of two near cells: from points of one through evenly spread directions,
    /// where these meet the other. All count alike, however close they are, which the kernel would
    /// not let them; and for all cells that one looks at they are the same, so that its directions
    /// are evenly full.
    std::vector<Look> near_looks(bool from_receiver, const Cell& from, const Cell& to,
                                 bool sampled) {
        const Element& x = from_receiver ? receiver_ : sender_;
        const Element& y = from_receiver ? sender_ : receiver_;
        const Eigen::Matrix3d& frame = from_receiver ? receiver_frame_ : sender_frame_;
        const Vec3 normal = (from_receiver ? sender_frame_ : receiver_frame_).col(2);
        const ParameterRect of_x = x.space.tree().rect(from), of_y = y.space.tree().rect(to);
        const std::uint32_t count =
            static_cast<std::uint32_t>(options_.points) * x.angle.functions();
        EvenPoints4 points(x.space.tree().position(from));
        std::vector<Look> result;
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::array<double, 4>& at = points.next();
            bool open = true;
            Look look;
            look.x = open_point(x, of_x, at[0], at[1], open);
            if (!open) continue;
            const Vec3 direction = frame * direction_from_square({at[2], at[3]});
            const double falling = -normal.dot(direction);
            const double height = normal.dot(look.x - y.geometry.vertex[0]);
            if (!(falling > 0) || !(height > 0)) continue;
            look.y = look.x + height / falling * direction;
            const Vec2 uv = y.geometry.parameters(look.y);
            if (!(uv[0] >= of_y.u0 && uv[0] < of_y.u1 && uv[1] >= of_y.v0 && uv[1] < of_y.v1) ||
                !y.is_sample_open(uv[0], uv[1]))
                continue;
            if (sampled) {
                ++cost_.rays;
                if (visibility_.occluded(look.x, x.quad, look.y, y.quad)) continue;
            }
            look.kernel = 1;
            if (!from_receiver) std::swap(look.x, look.y);
            result.push_back(look);
        }
        return result;
    }

    /// Gives its parts in space their shares.
    void divide(const Cell& x, const Cell& y, unsigned sub_domains, double exchange, bool sampled) {
        constexpr int points_a_part = 6;
        struct Part {
            Cell x, y;
            double share;
        };
        std::vector<Part> parts;
        double sum = 0;
        for (const bool with_rays : {true, false}) {
            if (with_rays && !sampled) continue;
            parts.clear();
            sum = 0;
            for (const Cell& i :
                 children_of(receiver_.space.tree(), x, (sub_domains & receiver_space) != 0))
                for (const Cell& j :
                     children_of(sender_.space.tree(), y, (sub_domains & sender_space) != 0)) {
                    double share = 0;
                    for (const Look& look : looks(i, j, points_a_part, with_rays))
                        share += look.kernel;
                    share *= receiver_.cell(i).area() * sender_.cell(j).area();
                    if (share > 0) parts.push_back({i, j, share});
                    sum += share;
                }
            if (sum > 0) break;
        }
        if (!(sum > 0)) {  // no point of either looks at the other: as it is
            const DirectedCandidate link = candidate(x, y, exchange);
            tell_apart(link, oracle_.judge(link), sampled);
            return;
        }
        for (const Part& part : parts)
            visit(part.x, part.y, exchange * part.share / sum, sampled);
    }

    /// The angular cells that a look belongs to, at one end.
    static std::array<AngularShare, 4> shares(const Element& element, const Eigen::Matrix3d& frame,
                                              const Vec3& towards, int level) {
        std::array<AngularShare, 4> result =
            angular_shares(element.angle, level, frame.transpose() * towards);
        for (AngularShare& one : result)
            one.cell = element.angle.position({level, one.cell});
        return result;
    }

    /// Records the link by the angular cells through which its ends see each other.
    void tell_apart(const DirectedCandidate& link, const DirectedVerdict& verdict, bool sampled) {
        // Along either axis of the unit disk that directions are projected to.
        constexpr double disk = 2, least_spanned = 0.5, most_spanned = 24;
        const double spread = std::min(
            disk, 2 * (link.receiver.reach + link.sender.reach) / std::max(link.distance, 1e-300));
        const int finest = std::max(verdict.receiver_angle, verdict.sender_angle);
        const double spanned =
            std::clamp(spread * (1 << finest) / std::sqrt(M_PI), least_spanned, most_spanned);
        const int count = static_cast<int>(std::lround(options_.points * spanned * spanned));
        const Cell &x = link.receiver.space, &y = link.sender.space;
        constexpr double near = 1;
        const bool from_receiver = is_directed(receiver_);
        std::vector<Look> seen;
        if (spread > near)
            seen =
                from_receiver ? near_looks(true, x, y, sampled) : near_looks(false, y, x, sampled);
        if (seen.empty()) seen = looks(x, y, count, sampled);
        if (seen.empty() && sampled) seen = looks(x, y, count, false);
        if (seen.empty())
            seen.push_back({link.receiver.outline.centre(), link.sender.outline.centre(), 1});
        by_angles_.clear();
        double sum = 0;
        for (const Look& look : seen) {
            const Vec3 towards = look.y - look.x;
            const auto at_receiver =
                shares(receiver_, receiver_frame_, towards, verdict.receiver_angle);
            const auto at_sender = shares(sender_, sender_frame_, -towards, verdict.sender_angle);
            for (const AngularShare& i : at_receiver)
                for (const AngularShare& j : at_sender)
                    if (i.share * j.share > 0)
                        by_angles_.push_back({i.cell, j.cell, look.kernel * i.share * j.share});
            sum += look.kernel;
        }
        std::stable_sort(by_angles_.begin(), by_angles_.end(),
                         [](const AnglesOfLook& a, const AnglesOfLook& b) {
                             return std::tie(a.receiver, a.sender) < std::tie(b.receiver, b.sender);
                         });
        for (auto look = by_angles_.begin(); look != by_angles_.end();) {
            const AnglesOfLook angles = *look;
            double share = 0;
            for (; look != by_angles_.end() && look->receiver == angles.receiver &&
                   look->sender == angles.sender;
                 ++look)
                share += look->share;
            result_.links.push_back({receiver_.space.tree().position(x), angles.receiver,
                                     sender_.space.tree().position(y), angles.sender,
                                     link.exchange * share / sum, true});
        }
    }

    const Element& receiver_;
    const Element& sender_;
    const AngularDetail& receiver_detail_;
    const AngularDetail& sender_detail_;
    Eigen::Matrix3d receiver_frame_, sender_frame_;
    const DirectionalOracle& oracle_;
    const Visibility& visibility_;
    DirectedRefinerOptions options_;
    std::vector<AnglesOfLook> by_angles_;  ///< of the link that is told apart
    DirectedPair result_;
    OracleCost cost_;
};

}  // namespace

std::vector<DirectedPair> refine_directions(const std::vector<Element>& elements,
                                            const std::vector<AngularDetail>& detail,
                                            const std::vector<PairLinks>& given,
                                            const DirectionalOracle& oracle,
                                            const Visibility& visibility,
                                            const DirectedRefinerOptions& options,
                                            const Progress& progress, OracleCost& cost) {
    std::vector<DirectedPair> result(given.size());
    std::vector<OracleCost> costs(given.size());
    const auto refine = [&](std::size_t p) {
        progress.check();
        const PairLinks& pair = given[p];
        if (!is_directed(elements[pair.receiver]) && !is_directed(elements[pair.sender])) {
            result[p] = {pair.receiver, pair.sender, {}};
            for (const LinkValue& link : pair.links)
                result[p].links.push_back({link.receiver, 0, link.sender, 0, link.exchange, false});
            return;
        }
        PairDirections directions(elements, detail, pair, oracle, visibility, options);
        for (const LinkValue& link : pair.links)
            directions.visit(elements[pair.receiver].space.tree().at(link.receiver),
                             elements[pair.sender].space.tree().at(link.sender), link.exchange,
                             link.sampled);
        costs[p] = directions.cost();
        result[p] = directions.take();
    };
    for_each_largest_first(
        given.size(), [&given](std::size_t p) { return given[p].links.size(); }, refine);
    for (const OracleCost& one : costs) {
        cost.rays += one.rays;
        cost.links_judged += one.links_judged;
    }
    return result;
}

}  // namespace lightwell
