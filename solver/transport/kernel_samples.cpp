#include "solver/transport/kernel_samples.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "solver/transport/kernel.h"

namespace lightwell {

namespace {

/// SplitMix64 (Steele, Lea, Flood 2014): one step turns a counter into well mixed bits.
std::uint64_t mixed(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15ULL;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
    return x ^ (x >> 31);
}

/// The additive sequence on the generalised golden ratio in four dimensions (Roberts 2018): x^5 = x
/// + 1.
class Sequence4 {
  public:
    explicit Sequence4(std::uint64_t seed) {
        for (double& start : at_) {
            seed = mixed(seed);
            start = static_cast<double>(seed >> 11) * 0x1p-53;
        }
    }
    double at(std::size_t k) const { return at_[k]; }
    void next() {
        constexpr std::array<double, 4> step = {0.85667488385450287, 0.73389185662718776,
                                                0.62870672083239870, 0.53859725722360993};
        for (std::size_t k = 0; k < 4; ++k) {
            at_[k] += step[k];
            at_[k] -= std::floor(at_[k]);
        }
    }

  private:
    std::array<double, 4> at_{};
};

std::uint64_t seed_of(const Link& link, const Element& receiver, const Element& sender) {
    const std::uint64_t a = mixed((std::uint64_t{link.receiver.element} << 32) +
                                  receiver.space.tree().position(link.receiver.space));
    return mixed(a ^ ((std::uint64_t{link.sender.element} << 32) +
                      sender.space.tree().position(link.sender.space)));
}

Vec3 point_in(const Element& element, const ParameterRect& r, double u, double v) {
    return element.geometry.point(r.u0 + u * (r.u1 - r.u0), r.v0 + v * (r.v1 - r.v0));
}

double softened_kernel(const Vec3& x, const Vec3& normal_x, const Vec3& y, const Vec3& normal_y,
                       double softening) {
    const double square = (y - x).squaredNorm();
    if (square >= softening * softening) return kernel(x, normal_x, y, normal_y);
    const double shrink = square / (softening * softening);
    return shrink * shrink * kernel(x, normal_x, y, normal_y);
}

Vec2 in_rect(const ParameterRect& r, double a, double b) {
    return {r.u0 + a * (r.u1 - r.u0), r.v0 + b * (r.v1 - r.v0)};
}

/// A half space: the side of a quad's plane that its normal points to.
struct FrontOf {
    Vec3 normal;
    Vec3 on_plane;
    bool holds(const Vec3& point) const { return normal.dot(point - on_plane) > 0; }
};

/// Draws another point of the rectangle if this one is buried or behind the other side's plane,
/// until one is neither; a rectangle without such a point is given up after a while.
Vec3 moved_to_open(const Element& element, const ParameterRect& rect, const FrontOf& front,
                   Sequence4& sequence, Vec2 at) {
    constexpr int most_attempts = 64;
    Vec3 point = element.geometry.point(at[0], at[1]);
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
        if (element.is_sample_open(at[0], at[1]) && front.holds(point)) break;
        sequence.next();
        at = in_rect(rect, sequence.at(0), sequence.at(1));
        point = element.geometry.point(at[0], at[1]);
    }
    return point;
}

/// Share of a cell in front of a plane that is open. Where none of its samples is in front, the
/// sliver that is counts as open, unless all of the cell is buried.
double open_share(const Element& element, const Cell& cell, const FrontOf& front) {
    if (element.open.empty()) return 1;
    constexpr int samples_along = 8;  // those of a finest cell's mask
    const ParameterRect rect = element.space.tree().rect(cell);
    int in_front = 0, open_in_front = 0;
    bool buried = true;
    for (int j = 0; j < samples_along; ++j) {
        for (int i = 0; i < samples_along; ++i) {
            const Vec2 at = in_rect(rect, (i + 0.5) / samples_along, (j + 0.5) / samples_along);
            const bool is_open = element.is_sample_open(at[0], at[1]);
            if (is_open) buried = false;
            if (!front.holds(element.geometry.point(at[0], at[1]))) continue;
            ++in_front;
            if (is_open) ++open_in_front;
        }
    }
    if (buried) return 0;
    return in_front == 0 ? 1 : static_cast<double>(open_in_front) / in_front;
}

FrontOf front_of(const Element& element, const Vec3& normal) {
    return {normal, element.geometry.vertex[0]};
}

}  // namespace

LinkChildren children_of(const LinkGeometry& link) {
    const auto list = [](const Element& element, const Cell& cell, bool finest,
                         std::array<Cell, 4>& children) {
        if (finest) {
            children[0] = cell;
            return 1;
        }
        const CellTree& tree = element.space.tree();
        const auto count = tree.children(cell.level);
        for (std::uint32_t c = 0; c < count; ++c)
            children[c] = tree.child(cell, c);
        return static_cast<int>(count);
    };
    LinkChildren children;
    children.receivers =
        list(*link.receiver, link.link.receiver.space, link.receiver_finest, children.receiver);
    children.senders =
        list(*link.sender, link.link.sender.space, link.sender_finest, children.sender);
    return children;
}

KernelVariation kernel_variation(const LinkGeometry& link, const LinkChildren& children) {
    const int nr = children.receivers, ns = children.senders;
    std::array<Vec3, 4> x, y;
    for (int i = 0; i < nr; ++i)
        x[i] = point_in(*link.receiver, link.receiver->space.tree().rect(children.receiver[i]), .5,
                        .5);
    for (int j = 0; j < ns; ++j)
        y[j] = point_in(*link.sender, link.sender->space.tree().rect(children.sender[j]), .5, .5);

    KernelVariation result;
    std::array<double, 4> row{}, column{};
    double squares = 0;
    for (int i = 0; i < nr; ++i) {
        for (int j = 0; j < ns; ++j) {
            const double f =
                kernel(x[i], link.receiver_facet.normal, y[j], link.sender_facet.normal);
            result.value[i][j] = f;
            row[i] += f / ns;
            column[j] += f / nr;
            squares += f * f / (nr * ns);
            result.mean += f / (nr * ns);
        }
    }
    result.variance = std::max(0.0, squares - result.mean * result.mean);
    for (int i = 0; i < nr; ++i)
        result.receiver_variance += (row[i] - result.mean) * (row[i] - result.mean) / nr;
    for (int j = 0; j < ns; ++j)
        result.sender_variance += (column[j] - result.mean) * (column[j] - result.mean) / ns;
    return result;
}

OpenShares open_shares(const LinkGeometry& link, const LinkChildren& children) {
    const FrontOf receiver_front = front_of(*link.receiver, link.receiver_facet.normal);
    const FrontOf sender_front = front_of(*link.sender, link.sender_facet.normal);
    OpenShares shares;
    for (int i = 0; i < children.receivers; ++i)
        shares.receiver[i] = open_share(*link.receiver, children.receiver[i], sender_front);
    for (int j = 0; j < children.senders; ++j)
        shares.sender[j] = open_share(*link.sender, children.sender[j], receiver_front);
    return shares;
}

StratifiedSamples sample_strata(const LinkGeometry& link, const LinkChildren& children,
                                int per_stratum, double softening, const Visibility& visibility,
                                OracleCost& cost) {
    StratifiedSamples result;
    result.lowest = std::numeric_limits<double>::infinity();
    result.highest = 0;
    const Vec3& normal_x = link.receiver_facet.normal;
    const Vec3& normal_y = link.sender_facet.normal;
    const FrontOf receiver_front = front_of(*link.receiver, normal_x);
    const FrontOf sender_front = front_of(*link.sender, normal_y);
    Sequence4 sequence(seed_of(link.link, *link.receiver, *link.sender));
    for (int i = 0; i < children.receivers; ++i) {
        const ParameterRect at_x = link.receiver->space.tree().rect(children.receiver[i]);
        for (int j = 0; j < children.senders; ++j) {
            const ParameterRect at_y = link.sender->space.tree().rect(children.sender[j]);
            double facing = 0, seen = 0;
            for (int k = 0; k < per_stratum; ++k) {
                sequence.next();
                const Vec2 r = in_rect(at_x, sequence.at(0), sequence.at(1));
                const Vec2 s = in_rect(at_y, sequence.at(2), sequence.at(3));
                const double anywhere =
                    softened_kernel(link.receiver->geometry.point(r[0], r[1]), normal_x,
                                    link.sender->geometry.point(s[0], s[1]), normal_y, softening);
                result.kernel[i][j] += anywhere / per_stratum;
                const Vec3 x = moved_to_open(*link.receiver, at_x, sender_front, sequence, r);
                const Vec3 y = moved_to_open(*link.sender, at_y, receiver_front, sequence, s);
                const double f = softened_kernel(x, normal_x, y, normal_y, softening);
                double through = 0;
                if (f > 0) {
                    ++cost.rays;
                    if (!visibility.occluded(x, link.receiver->quad, y, link.sender->quad))
                        through = f;
                }
                facing += f;
                seen += through;
                result.lowest = std::min(result.lowest, anywhere > 0 ? through : 0);
                result.highest = std::max(result.highest, through);
            }
            result.seen[i][j] = facing > 0 ? seen / facing : 0;
        }
    }
    return result;
}

}  // namespace lightwell
