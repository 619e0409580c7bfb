#include "runtime/drawing/emitter_shafts.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace lightwell {

namespace {

/// Parts of all sides together times emitters, about; at least one part for each side.
constexpr double shaft_count = 60000;
constexpr double most_parts = 12000;
constexpr int most_parts_along = 64;

/// How far on the inner side of a plane something must be to count, relative to its size.
constexpr double tolerance = 1e-9;

bool is_inside(const ConvexPolygon& polygon, const Plane& plane, double slack) {
    return std::all_of(polygon.begin(), polygon.end(),
                       [&](const Vec3& vertex) { return plane.height(vertex) >= -slack; });
}

/// Cuts the region by the planes through an edge of `a` and a vertex of `b` that have both on one
/// side.
void cut_by_supports(const ConvexPolygon& a, const ConvexPolygon& b, double slack,
                     ConvexRegion& region) {
    for (int i = 0; i < a.size(); ++i)
        for (const Vec3& apex : b) {
            const Vec3 across = (a.after(i) - a[i]).cross(apex - a[i]);
            const double length = across.norm();
            if (!(length > slack * (a.after(i) - a[i]).norm())) continue;
            bool is_cut = false;
            for (const double sign : {1.0, -1.0}) {
                const Vec3 normal = sign / length * across;
                const Plane plane{normal, normal.dot(a[i])};
                if (is_cut || !is_inside(a, plane, slack) || !is_inside(b, plane, slack)) continue;
                region.cut(plane);
                is_cut = true;
            }
            if (is_cut) break;
        }
}

/// The convex hull of two polygons that lie in front of each other, or somewhat more.
ConvexRegion region_between(const ConvexPolygon& a, const ConvexPolygon& b) {
    Eigen::AlignedBox3d box;
    for (const ConvexPolygon* polygon : {&a, &b})
        for (const Vec3& vertex : *polygon)
            box.extend(vertex);
    const double slack = tolerance * box.diagonal().norm();
    // Flat boxes have no inside; a quad must not miss for that.
    box.extend(box.min() - Vec3::Constant(slack));
    box.extend(box.max() + Vec3::Constant(slack));
    ConvexRegion region(box);
    for (const ConvexPolygon* end : {&a, &b}) {
        const Vec3 normal = end->vector_area().normalized();
        region.cut({normal, normal.dot((*end)[0]) + slack});
    }
    cut_by_supports(a, b, slack, region);
    cut_by_supports(b, a, slack, region);
    return region;
}

/// Whether a quad cuts the segment between two points, ends and rim included, up to rounding.
bool cuts(const Quad& quad, const Vec3& from, const Vec3& to) {
    const Vec3 normal = quad.normal();
    const double before = normal.dot(from - quad.vertex[0]);
    const double behind = normal.dot(to - quad.vertex[0]);
    if (!(before * behind < 0)) return false;
    const Vec3 at = from + before / (before - behind) * (to - from);
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3& corner = quad.vertex[k];
        if (normal.dot((quad.vertex[(k + 1) % 4] - corner).cross(at - corner)) < 0) return false;
    }
    return true;
}

/// Whether a quad hides all of one polygon from all of another: since it is convex it does if it
/// hides every vertex from every vertex.
bool hides(const Quad& quad, const ConvexPolygon& a, const ConvexPolygon& b) {
    return std::all_of(a.begin(), a.end(), [&](const Vec3& from) {
        return std::all_of(b.begin(), b.end(),
                           [&](const Vec3& to) { return cuts(quad, from, to); });
    });
}

struct Side {
    int quad;
    bool front;
    int columns, rows;
    std::size_t first;  ///< part, of all sides'
};

/// What may stand between a part of a side and an emitter.
struct Between {
    bool is_dark = false;
    std::vector<int> quads;
};

/// Looks for it.
class Search {
  public:
    Search(const Scene& scene, const std::vector<Quad>& quads)
        : scene_(scene), quads_(quads), tree_(quads) {}

    Between between(const Quad& part, int on_quad, int emitter) const {
        Between result{true, {}};
        if (on_quad == emitter) return result;
        const Quad& other = quads_[static_cast<std::size_t>(emitter)];
        const Plane horizon{part.normal(), part.normal().dot(part.vertex[0])};
        const ConvexPolygon seen = clipped(ConvexPolygon(other), horizon);
        if (seen.empty()) return result;
        const Vec3 normal = other.normal();
        for (const double sign : {1.0, -1.0}) {
            const bool emits = sign > 0 || scene_.material_of(emitter).emitting == Sides::both;
            const Plane plane{sign * normal, sign * normal.dot(other.vertex[0])};
            const ConvexPolygon lit = clipped(ConvexPolygon(part), plane);
            if (!emits || lit.empty()) continue;
            add(lit, sign > 0 ? seen : seen.reversed(), on_quad, emitter, result);
        }
        return result;
    }

  private:
    void add(const ConvexPolygon& lit, const ConvexPolygon& emitting, int on_quad, int emitter,
             Between& result) const {
        std::vector<int> found;
        tree_.collect(region_between(lit, emitting), on_quad, emitter, found);
        for (const int quad : found)
            if (hides(quads_[static_cast<std::size_t>(quad)], lit, emitting)) return;
        result.is_dark = false;
        result.quads.insert(result.quads.end(), found.begin(), found.end());
    }

    const Scene& scene_;
    const std::vector<Quad>& quads_;
    OccluderTree tree_;
};

std::vector<Side> sides_of(const std::vector<Quad>& quads, std::size_t emitters) {
    double area = 0;
    for (const Quad& quad : quads)
        area += 2 * quad.area();
    const double parts =
        std::min(most_parts, shaft_count / static_cast<double>(std::max<std::size_t>(1, emitters)));
    const double size = std::sqrt(area / parts);
    const auto along = [&](const Vec3& side) {
        return std::clamp(static_cast<int>(std::lround(side.norm() / size)), 1, most_parts_along);
    };
    std::vector<Side> sides;
    std::size_t first = 0;
    for (int q = 0; q < static_cast<int>(quads.size()); ++q)
        for (const bool front : {true, false}) {
            const auto& v = quads[static_cast<std::size_t>(q)].vertex;
            const Side side{q, front, along(0.5 * (v[1] + v[2] - v[0] - v[3])),
                            along(0.5 * (v[2] + v[3] - v[0] - v[1])), first};
            first += static_cast<std::size_t>(side.columns) * static_cast<std::size_t>(side.rows);
            sides.push_back(side);
        }
    return sides;
}

}  // namespace

EmitterShafts::EmitterShafts(const Scene& scene) {
    std::vector<Quad> quads;
    for (int q = 0; q < static_cast<int>(scene.quads.size()); ++q) {
        quads.push_back(scene.quads[static_cast<std::size_t>(q)].quad);
        if ((scene.material_of(q).emission > 0).any()) emitters_.push_back(q);
    }
    if (emitters_.empty()) return;
    const Search search(scene, quads);
    const std::vector<Side> sides = sides_of(quads, emitters_.size());
    const Side& last = sides.back();
    const std::size_t parts = last.first + static_cast<std::size_t>(last.columns * last.rows);
    std::vector<Between> between(parts * emitters_.size());
    tbb::parallel_for(std::size_t{0}, sides.size(), [&](std::size_t s) {
        const Side& side = sides[s];
        const Quad& quad = quads[static_cast<std::size_t>(side.quad)];
        for (int row = 0; row < side.rows; ++row)
            for (int column = 0; column < side.columns; ++column) {
                const Quad part =
                    quad.part(1.0 * column / side.columns, (column + 1.0) / side.columns,
                              1.0 * row / side.rows, (row + 1.0) / side.rows);
                const std::size_t at =
                    side.first + static_cast<std::size_t>(row * side.columns + column);
                for (std::size_t e = 0; e < emitters_.size(); ++e)
                    between[at * emitters_.size() + e] = search.between(
                        side.front ? part : part.reversed(), side.quad, emitters_[e]);
            }
    });

    for (const Side& side : sides)
        records_.push_back({static_cast<float>(side.columns), static_cast<float>(side.rows),
                            static_cast<float>(sides.size() + side.first * emitters_.size()), 0});
    std::vector<float> lists;
    for (const Between& shaft : between) {
        records_.push_back({static_cast<float>(lists.size()),
                            shaft.is_dark ? -1.0F : static_cast<float>(shaft.quads.size()), 0, 0});
        for (const int quad : shaft.quads)
            lists.push_back(static_cast<float>(quad));
    }
    first_list_ = static_cast<int>(records_.size());
    lists.resize((lists.size() + 3) / 4 * 4);
    for (std::size_t k = 0; k < lists.size(); k += 4)
        records_.push_back({lists[k], lists[k + 1], lists[k + 2], lists[k + 3]});
}

}  // namespace lightwell
