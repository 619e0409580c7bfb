#include "solver/reading/quads_from_polygons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "solver/reading/polygon_cutting.h"
#include "solver/reading/polygon_shape.h"

namespace lightwell {

namespace {

/// For every vertex the first one in exactly the same place. Exporters repeat vertices for each
/// face; without this no two triangles would share a side.
std::vector<int> welded(const std::vector<Vec3>& vertices) {
    std::vector<int> order(vertices.size());
    std::iota(order.begin(), order.end(), 0);
    const auto position = [&](int i) -> const Vec3& {
        return vertices[static_cast<std::size_t>(i)];
    };
    std::sort(order.begin(), order.end(), [&](int a, int b) {
        const Vec3 &p = position(a), &q = position(b);
        return std::tie(p[0], p[1], p[2], a) < std::tie(q[0], q[1], q[2], b);
    });
    std::vector<int> first(vertices.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto vertex = static_cast<std::size_t>(order[i]);
        const bool same = i > 0 && position(order[i]) == position(order[i - 1]);
        first[vertex] = same ? first[static_cast<std::size_t>(order[i - 1])] : order[i];
    }
    return first;
}

/// How round a triangle is: its area over its longest side squared.
double roundness(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double longest =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    return (b - a).cross(c - a).norm() / longest;
}

/// The first round of an outline that goes round several times.
std::vector<int> first_round(const std::vector<int>& ids) {
    for (std::size_t length = 3; 2 * length <= ids.size(); ++length)
        if (ids.size() % length == 0 &&
            std::equal(ids.begin() + static_cast<std::ptrdiff_t>(length), ids.end(), ids.begin()))
            return {ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(length)};
    return ids;
}

using Corners = std::array<int, 3>;

/// The ears of an outline; none if it crosses itself.
std::vector<Corners> ears_of(const std::vector<Vec2>& outline) {
    if (crosses_itself(outline)) return {};
    return clip_ears(outline);
}

/// All triangles at the first corner.
std::vector<Corners> fan(int corners) {
    std::vector<Corners> triangles;
    for (int i = 2; i < corners; ++i)
        triangles.push_back({0, i - 1, i});
    return triangles;
}

/// Beyond this share of the diameter, a corner off the mean plane is more than rounding. Below it
/// vertices stay as they are, so that those that were equal stay equal.
constexpr double rounding = 1e-12;

class QuadMaker {
  public:
    QuadMaker(const PolygonSoup& soup, double metres_per_unit, const PolygonRule& rule)
        : soup_(soup), rule_(rule) {
        vertices_.reserve(soup.vertices.size());
        for (const Vec3& vertex : soup.vertices)
            vertices_.push_back(metres_per_unit * vertex);
        same_place_ = welded(vertices_);
    }

    QuadsOfPolygons make() {
        counts().faces = static_cast<int>(soup_.polygons.size());
        for (face_ = 0; face_ < counts().faces; ++face_)
            take(polygon(face_));
        make_triangles_quads();
        std::stable_sort(made_.quads.begin(), made_.quads.end(),
                         [](const SceneQuad& a, const SceneQuad& b) { return a.face < b.face; });
        counts().elements = static_cast<int>(made_.quads.size());
        warn();
        return std::move(made_);
    }

  private:
    PolygonCounts& counts() { return made_.counts; }
    const Polygon& polygon(int face) const {
        return soup_.polygons[static_cast<std::size_t>(face)];
    }
    const Vec3& position(int vertex) const { return vertices_[static_cast<std::size_t>(vertex)]; }

    /// Sorts a polygon into its kind and makes quads or triangles of it.
    void take(const Polygon& shape) {
        if (shape.count > most_corners)
            throw InputError(Place{soup_.file, shape.line},
                             fmt::format("a polygon of {} corners; at most {} are read",
                                         shape.count, most_corners));
        const std::vector<int> ids = shaping_vertices(shape);
        if (ids.size() < 3) return leave_out(degenerate_, counts().degenerate, shape);
        if (ids.size() == 3) {
            ++counts().triangles;
            return add_triangle(ids[0], ids[1], ids[2]);
        }
        Outline outline = outline_of(ids);
        const double size = diameter(outline);
        const double off = out_of_plane(outline);
        if (!(vector_area(outline).norm() > rule_.flatness * size * size))
            return leave_out(crossing_, counts().crossing, shape);
        if (off > rule_.planarity * size) return take_bent(shape, ids, outline);
        if (off > rounding * size) {
            outline = flattened(outline);
            flattened_.add(shape.line);
            ++counts().flattened;
        }
        take_planar(shape, ids, outline);
    }

    /// Corners of the polygon that shape it, as vertices.
    std::vector<int> shaping_vertices(const Polygon& shape) const {
        std::vector<int> ids;
        for (int i = shape.first; i < shape.first + shape.count; ++i)
            ids.push_back(
                same_place_[static_cast<std::size_t>(soup_.corners[static_cast<std::size_t>(i)])]);
        ids = first_round(ids);
        const Outline outline = outline_of(ids);
        std::vector<int> kept;
        for (const int corner : shaping_corners(outline, rule_.flatness * diameter(outline)))
            kept.push_back(ids[static_cast<std::size_t>(corner)]);
        return kept;
    }

    Outline outline_of(const std::vector<int>& ids) const {
        Outline outline;
        for (const int id : ids)
            outline.push_back(position(id));
        return outline;
    }

    void take_planar(const Polygon& shape, const std::vector<int>& ids, const Outline& outline) {
        const std::vector<Vec2> flat = in_mean_plane(outline);
        if (is_convex(flat)) {
            ++(ids.size() == 4 ? counts().quads : counts().larger);
            return add_convex(outline, flat);
        }
        const auto ears = ears_of(flat);
        if (ears.empty()) return leave_out(crossing_, counts().crossing, shape);
        ++counts().concave;
        concave_.add(shape.line);
        add_triangles(ids, ears);
    }

    void take_bent(const Polygon& shape, const std::vector<int>& ids, const Outline& outline) {
        const std::vector<Vec2> flat = in_mean_plane(outline);
        ++counts().bent;
        bent_.add(shape.line);
        if (ids.size() > 4 || !is_convex(flat)) {
            const auto ears = ears_of(flat);
            return add_triangles(ids, ears.empty() ? fan(static_cast<int>(ids.size())) : ears);
        }
        const auto& p = outline;
        const double along_02 = std::min(roundness(p[0], p[1], p[2]), roundness(p[0], p[2], p[3]));
        const double along_13 = std::min(roundness(p[1], p[2], p[3]), roundness(p[1], p[3], p[0]));
        // In doubt the first, whatever rounding says.
        const std::size_t start = along_13 > along_02 * (1 + 1e-9) ? 1 : 0;
        add_triangle(ids[start], ids[start + 1], ids[start + 2]);
        add_triangle(ids[start], ids[start + 2], ids[(start + 3) % 4]);
    }

    void add_convex(const Outline& outline, const std::vector<Vec2>& flat) {
        const auto corner = [&](int i) -> const Vec3& {
            return outline[static_cast<std::size_t>(i)];
        };
        if (outline.size() == 4)
            return add_quad({{corner(0), corner(1), corner(2), corner(3)}}, face_);
        const ConvexCut cut = cut_convex(flat);
        for (const auto& q : cut.quads)
            add_quad({{corner(q[0]), corner(q[1]), corner(q[2]), corner(q[3])}}, face_);
        for (const auto& t : cut.triangles)
            add_cut_triangle(corner(t[0]), corner(t[1]), corner(t[2]), face_);
    }

    void add_triangles(const std::vector<int>& ids, const std::vector<Corners>& triangles) {
        const auto id = [&](int i) { return ids[static_cast<std::size_t>(i)]; };
        for (const Corners& t : triangles)
            add_triangle(id(t[0]), id(t[1]), id(t[2]));
    }

    void add_triangle(int a, int b, int c) {
        // An ear may be as flat as a corner that is left out.
        if (shaping_corners({position(a), position(b), position(c)}, 0).size() < 3) return;
        triangles_.push_back({{a, b, c}, polygon(face_).material, face_});
    }

    void add_quad(const Quad& quad, int face) {
        made_.quads.push_back({quad, polygon(face).material, face, polygon(face).line});
    }

    void add_cut_triangle(const Vec3& a, const Vec3& b, const Vec3& c, int face) {
        ++counts().cut;
        for (const Quad& quad : cut_triangle(a, b, c))
            add_quad(quad, face);
    }

    void make_triangles_quads() {
        std::vector<bool> paired(triangles_.size(), false);
        for (const TrianglePair& pair : pair_triangles(vertices_, triangles_, rule_.pairing)) {
            paired[static_cast<std::size_t>(pair.first)] = true;
            paired[static_cast<std::size_t>(pair.second)] = true;
            add_pair(pair);
        }
        for (std::size_t t = 0; t < triangles_.size(); ++t)
            if (!paired[t]) {
                const auto& v = triangles_[t].vertex;
                add_cut_triangle(position(v[0]), position(v[1]), position(v[2]),
                                 triangles_[t].face);
            }
    }

    void add_pair(const TrianglePair& pair) {
        ++counts().pairs;
        Outline outline;
        for (const int id : pair.vertex)
            outline.push_back(position(id));
        if (out_of_plane(outline) > rounding * diameter(outline)) outline = flattened(outline);
        add_quad({{outline[0], outline[1], outline[2], outline[3]}},
                 std::min(triangles_[static_cast<std::size_t>(pair.first)].face,
                          triangles_[static_cast<std::size_t>(pair.second)].face));
    }

    void leave_out(Occurrences& kind, int& count, const Polygon& shape) {
        kind.add(shape.line);
        ++count;
    }

    void warn() {
        const auto report = [&](const Occurrences& kind, const std::string& message) {
            kind.report(soup_.file, message, made_.warnings);
        };
        report(bent_, fmt::format("bent polygon (corners off the mean plane by more than {:g} of "
                                  "the diameter): cut into triangles",
                                  rule_.planarity));
        report(flattened_, "slightly bent polygon: its corners are moved onto the mean plane");
        report(concave_, "concave polygon: cut into triangles");
        report(degenerate_, "polygon without area: left out");
        report(crossing_, "polygon whose outline crosses or overlaps itself: left out");
    }

    const PolygonSoup& soup_;
    PolygonRule rule_;
    std::vector<Vec3> vertices_;  ///< [m]
    std::vector<int> same_place_;
    int face_ = 0;  ///< the polygon in hand
    std::vector<Triangle> triangles_;
    QuadsOfPolygons made_;
    Occurrences bent_, flattened_, concave_, degenerate_, crossing_;
};

}  // namespace

QuadsOfPolygons quads_from_polygons(const PolygonSoup& soup, double metres_per_unit,
                                    const PolygonRule& rule) {
    return QuadMaker(soup, metres_per_unit, rule).make();
}

}  // namespace lightwell
