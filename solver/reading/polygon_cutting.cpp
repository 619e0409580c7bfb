#include "solver/reading/polygon_cutting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

/// Sines below this are those of flat corners.
constexpr double rounding = 1e-9;

/// Sine of the angle at b, positive for left turns; 0 if a side has no length.
double corner_sine(const Vec2& a, const Vec2& b, const Vec2& c) {
    const double lengths = (b - a).norm() * (c - b).norm();
    return lengths > 0 ? turn(a, b, c) / lengths : 0;
}

template <std::size_t n>
double worst_sine(const std::vector<Vec2>& outline, const std::array<int, n>& piece) {
    double worst = 1;
    const auto at = [&](std::size_t i) { return outline[static_cast<std::size_t>(piece[i % n])]; };
    for (std::size_t i = 0; i < n; ++i)
        worst = std::min(worst, corner_sine(at(i), at(i + 1), at(i + 2)));
    return worst;
}

/// The ladder whose first rung is the side between corners `start` and `start` - 1.
ConvexCut ladder(int corners, int start) {
    ConvexCut cut;
    const auto corner = [&](int i) { return (start + i + corners) % corners; };
    int low = 0, high = corners - 1;
    for (; high - low >= 3; ++low, --high)
        cut.quads.push_back({corner(low), corner(low + 1), corner(high - 1), corner(high)});
    if (high - low == 2) cut.triangles.push_back({corner(low), corner(low + 1), corner(high)});
    return cut;
}

double worst_sine(const std::vector<Vec2>& outline, const ConvexCut& cut) {
    double worst = 1;
    for (const auto& quad : cut.quads)
        worst = std::min(worst, worst_sine(outline, quad));
    for (const auto& piece : cut.triangles)
        worst = std::min(worst, worst_sine(outline, piece));
    return worst;
}

/// The corners not yet clipped, as a ring, and how good an ear each would be.
class EarClipper {
  public:
    explicit EarClipper(const std::vector<Vec2>& outline)
        : outline_(outline), ring_(outline.size()), quality_(outline.size()) {
        std::iota(ring_.begin(), ring_.end(), 0);
        for (std::size_t i = 0; i < ring_.size(); ++i)
            judge(i);
    }

    std::vector<std::array<int, 3>> clip() {
        std::vector<std::array<int, 3>> triangles;
        while (ring_.size() > 3) {
            const auto best = static_cast<std::size_t>(
                std::max_element(quality_.begin(), quality_.end()) - quality_.begin());
            triangles.push_back({before(best), ring_[best], after(best)});
            ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(best));
            quality_.erase(quality_.begin() + static_cast<std::ptrdiff_t>(best));
            judge((best + ring_.size() - 1) % ring_.size());
            judge(best % ring_.size());
        }
        triangles.push_back({ring_[0], ring_[1], ring_[2]});
        const bool overlaps = std::any_of(triangles.begin(), triangles.end(), [&](const auto& ear) {
            return corner_sine(point(ear[0]), point(ear[1]), point(ear[2])) < -rounding;
        });
        if (overlaps) triangles.clear();
        return triangles;
    }

  private:
    int before(std::size_t i) const { return ring_[(i + ring_.size() - 1) % ring_.size()]; }
    int after(std::size_t i) const { return ring_[(i + 1) % ring_.size()]; }
    const Vec2& point(int corner) const { return outline_[static_cast<std::size_t>(corner)]; }

    /// An ear turns left and holds no other corner. What is no ear ranks by its turn, below all
    /// ears: rounding can hide the last ears of an outline that nearly touches itself.
    void judge(std::size_t i) {
        const std::array<int, 3> ear = {before(i), ring_[i], after(i)};
        const double sine = corner_sine(point(ear[0]), point(ear[1]), point(ear[2]));
        if (sine <= 0)
            quality_[i] = sine - 2;
        else if (holds_a_corner(ear))
            quality_[i] = sine - 1;
        else
            quality_[i] = worst_sine(outline_, ear);
    }

    /// Another corner in the place of one of the ear's own is in the way only if the outline goes
    /// on from the ear's tip into the ear.
    bool holds_a_corner(const std::array<int, 3>& ear) const {
        const Vec2 &a = point(ear[0]), &b = point(ear[1]), &c = point(ear[2]);
        const auto opens_to = [&](const Vec2& p) { return turn(a, b, p) > 0 && turn(b, c, p) > 0; };
        for (std::size_t i = 0; i < ring_.size(); ++i) {
            const int other = ring_[i];
            const Vec2& p = point(other);
            if (other == ear[0] || other == ear[1] || other == ear[2] || p == a || p == c) continue;
            if (p == b) {
                if (opens_to(point(before(i))) || opens_to(point(after(i)))) return true;
            } else if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) {
                return true;
            }
        }
        return false;
    }

    const std::vector<Vec2>& outline_;
    std::vector<int> ring_;
    std::vector<double> quality_;
};

}  // namespace

std::array<Quad, 3> cut_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    const Vec3 middle = (a + b + c) / 3;
    return {Quad{{a, ab, middle, ca}}, Quad{{b, bc, middle, ab}}, Quad{{c, ca, middle, bc}}};
}

ConvexCut cut_convex(const std::vector<Vec2>& outline) {
    const int corners = static_cast<int>(outline.size());
    LIGHTWELL_CHECK_OP(corners, >=, 4);
    ConvexCut best;
    double best_sine = -std::numeric_limits<double>::infinity();
    for (int start = 0; start < corners; ++start) {
        ConvexCut cut = ladder(corners, start);
        const double sine = worst_sine(outline, cut);
        // Equal up to rounding counts as equal, so that the first wins on every machine.
        if (sine > best_sine + 1e-9) {
            best_sine = sine;
            best = std::move(cut);
        }
    }
    return best;
}

std::vector<std::array<int, 3>> clip_ears(const std::vector<Vec2>& outline) {
    LIGHTWELL_CHECK_OP(outline.size(), >=, 3u);
    return EarClipper(outline).clip();
}

}  // namespace lightwell
