#include "radiance4d/scene/visible_part.h"

#include <algorithm>
#include <limits>

#include "radiance4d/scene/convex_region.h"

namespace lightwell {

namespace {

constexpr double narrowest = 1e-12;  ///< width of a piece that counts, relative to the target
constexpr double flush = 1e-6;       ///< depth that counts as being in the plane, relative
constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();

}  // namespace

std::vector<ConvexPolygon> visible_part(const Vec3& x, const ConvexPolygon& target,
                                        const std::vector<Quad>& quads,
                                        const std::vector<int>& candidates) {
    std::vector<Shadow> shadows;
    shadows.reserve(candidates.size());
    for (const int quad : candidates)
        shadows.emplace_back(x, quads[static_cast<std::size_t>(quad)]);
    return visible_part(x, target, std::move(shadows));
}

std::vector<ConvexPolygon> visible_part(const Vec3& x, const ConvexPolygon& target,
                                        std::vector<Shadow> shadows) {
    if (target.size() < 3) return {};
    double largest = x.cwiseAbs().maxCoeff();
    for (const Vec3& vertex : target)
        largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
    const double extent = target.extent();
    const double sliver = narrowest * extent + rounding * largest;

    const Vec3 area = target.vector_area();
    const double height = area.dot(x - target[0]);
    if (std::abs(height) <= rounding * largest * area.norm()) return {};

    // What hides most goes first: the sooner a piece is gone, the less it is cut up.
    std::stable_sort(shadows.begin(), shadows.end(),
                     [](const Shadow& a, const Shadow& b) { return a.breadth() > b.breadth(); });
    std::vector<ConvexPolygon> pieces{target.moved(-x)};
    for (const Shadow& shadow : shadows) {
        if (pieces.empty()) break;
        shadow.subtract_from(pieces, sliver, flush * extent);
    }
    for (ConvexPolygon& piece : pieces)
        piece = piece.moved(x);
    return pieces;
}

bool hides_all(const Shadow& shadow, const ConvexPolygon& target) {
    return shadow.covers(target.moved(-shadow.apex()), flush * target.extent());
}

bool may_occlude(const Vec3& x, const ConvexPolygon& target, const Quad& quad) {
    return !region_between(x, target).misses(quad);
}

}  // namespace lightwell
