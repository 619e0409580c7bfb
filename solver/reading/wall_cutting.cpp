#include "solver/reading/wall_cutting.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "radiance4d/scene/scene_quads.h"
#include "solver/reading/polygon_shape.h"
#include "solver/reading/wall_contacts.h"
#include "solver/reading/welded_quads.h"

namespace lightwell {

namespace {

/// A share of cover that differs by less is the same but for rounding.
constexpr double rounding = 1e-9;

/// The least side of a piece, in tolerances of the scene: pieces of tiny quads must still be far
/// wider than what is taken as nothing.
constexpr double least_side_in_tolerances = 64;

/// A contact in the coordinates of the quad's plane.
struct Wall {
    Vec2 from, to;
    double length() const { return (to - from).norm(); }
};

/// A straight cut from the side between corners `side` and `side` + 1 to the opposite one. `near`
/// and `far` are its ends' parameters on the two sides, both counted in the same sense.
struct Cut {
    std::size_t side = 0;
    double near = 0, far = 0;
    double cover = 0;  ///< share of its length that walls stand on
};

/// A part of a quad and the walls inside it, longest first.
struct Piece {
    Quad quad;
    std::vector<Wall> walls;
    double least_cover = 0;
};

/// Distance of a point from the line through a and b, positive on its left [m].
double left_of(const Vec2& a, const Vec2& b, const Vec2& point) {
    return turn(a, b, point) / (b - a).norm();
}

/// How far the segment from one end to the other must go, as a share, to reach height 0.
double share_to_zero(double height_from, double height_to) {
    return height_from / (height_from - height_to);
}

/// Cuts one quad.
class QuadCutter {
  public:
    QuadCutter(const Quad& quad, double tolerance, const WallCutRule& rule)
        : origin_(quad.centre()),
          along_((quad.vertex[1] - quad.vertex[0]).normalized()),
          across_(quad.normal().cross(along_)),
          tolerance_(tolerance),
          rule_(rule) {
        const double diagonal = std::max((quad.vertex[2] - quad.vertex[0]).norm(),
                                         (quad.vertex[3] - quad.vertex[1]).norm());
        least_side_ = std::max(rule.least_side * diagonal, least_side_in_tolerances * tolerance);
        vertices_.assign(quad.vertex.begin(), quad.vertex.end());
    }

    /// The pieces; the quad alone where nothing cuts it.
    std::vector<Quad> cut(const Quad& quad, const std::vector<Segment>& contacts) {
        std::vector<Wall> walls;
        for (const Segment& contact : contacts)
            walls.push_back({flat(contact.from), flat(contact.to)});
        std::deque<Piece> waiting = {{quad, walls_inside(quad, walls), rule_.least_cover}};
        std::vector<Quad> done;
        while (!waiting.empty()) {
            const Piece piece = std::move(waiting.front());
            waiting.pop_front();
            const std::optional<Cut> best = best_cut(piece);
            const bool full =
                static_cast<int>(done.size() + waiting.size()) + 2 > rule_.most_pieces;
            if (best && full) unfinished_ = true;
            if (!best || full) {
                done.push_back(piece.quad);
                continue;
            }
            for (const Quad& part : parts_of(piece.quad, *best))
                waiting.push_back(
                    {part, walls_inside(part, piece.walls), rule_.least_cover_of_pieces});
        }
        return done;
    }

    /// Whether the bound on pieces kept a cut from being made.
    bool unfinished() const { return unfinished_; }

  private:
    using Corners = std::array<Vec2, 4>;

    Vec2 flat(const Vec3& point) const {
        return {along_.dot(point - origin_), across_.dot(point - origin_)};
    }
    Corners corners_of(const Quad& quad) const {
        return {flat(quad.vertex[0]), flat(quad.vertex[1]), flat(quad.vertex[2]),
                flat(quad.vertex[3])};
    }

    /// The parts of walls that stand on a piece, longest first.
    std::vector<Wall> walls_inside(const Quad& quad, const std::vector<Wall>& walls) const {
        const Corners corners = corners_of(quad);
        std::vector<Wall> inside;
        for (Wall wall : walls)
            if (clip(wall, corners)) inside.push_back(wall);
        std::stable_sort(inside.begin(), inside.end(),
                         [](const Wall& a, const Wall& b) { return a.length() > b.length(); });
        return inside;
    }

    /// Leaves the part within the corners; false if there is none.
    bool clip(Wall& wall, const Corners& corners) const {
        for (std::size_t i = 0; i < 4; ++i) {
            const Vec2 &a = corners[i], &b = corners[(i + 1) % 4];
            const double from = left_of(a, b, wall.from), to = left_of(a, b, wall.to);
            if (from <= 0 && to <= 0) return false;
            if (from >= 0 && to >= 0) continue;
            const Vec2 crossing = wall.from + share_to_zero(from, to) * (wall.to - wall.from);
            (from < 0 ? wall.from : wall.to) = crossing;
        }
        return wall.length() > tolerance_;
    }

    /// The cut with the largest cover, if it is enough; of equals, the one along the longest wall.
    std::optional<Cut> best_cut(const Piece& piece) const {
        const Corners corners = corners_of(piece.quad);
        std::optional<Cut> best;
        for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
            std::vector<Cut> tried;
            for (const Wall& wall : piece.walls) {
                std::optional<Cut> cut = cut_along(wall, corners, side);
                if (!cut || is_among(tried, *cut, corners)) continue;
                tried.push_back(*cut);
                cut->cover = cover_of(*cut, piece.walls, corners);
                if (cut->cover < piece.least_cover) continue;
                if (!best || cut->cover > best->cover + rounding) best = cut;
            }
        }
        return best;
    }

    /// The cut along the line of a wall, if that meets both sides and leaves sound pieces.
    std::optional<Cut> cut_along(const Wall& wall, const Corners& corners, std::size_t side) const {
        const Vec2 &a0 = corners[side], &a1 = corners[side + 1];
        const Vec2 &b0 = corners[(side + 3) % 4], &b1 = corners[side + 2];
        const auto height = [&](const Vec2& corner) { return left_of(wall.from, wall.to, corner); };
        const double ha0 = height(a0), ha1 = height(a1), hb0 = height(b0), hb1 = height(b1);
        if (ha0 * ha1 >= 0 || hb0 * hb1 >= 0) return std::nullopt;
        const Cut cut{side, share_to_zero(ha0, ha1), share_to_zero(hb0, hb1), 0};
        const double least_near = least_side_ / (a1 - a0).norm();
        const double least_far = least_side_ / (b1 - b0).norm();
        const bool wide = std::min(cut.near, 1 - cut.near) >= least_near &&
                          std::min(cut.far, 1 - cut.far) >= least_far;
        return wide && taper_of(cut) <= rule_.most_taper ? std::optional(cut) : std::nullopt;
    }

    static double taper_of(const Cut& cut) {
        const double first = cut.near / cut.far, second = (1 - cut.near) / (1 - cut.far);
        return std::max({first, 1 / first, second, 1 / second});
    }

    bool is_among(const std::vector<Cut>& tried, const Cut& cut, const Corners& corners) const {
        const double near_length = (corners[cut.side + 1] - corners[cut.side]).norm();
        const double far_length = (corners[cut.side + 2] - corners[(cut.side + 3) % 4]).norm();
        return std::any_of(tried.begin(), tried.end(), [&](const Cut& other) {
            return std::abs(cut.near - other.near) * near_length <= tolerance_ &&
                   std::abs(cut.far - other.far) * far_length <= tolerance_;
        });
    }

    /// The share of a cut that walls stand on; overlapping ones count once.
    double cover_of(const Cut& cut, const std::vector<Wall>& walls, const Corners& corners) const {
        const Vec2 from =
            corners[cut.side] + cut.near * (corners[cut.side + 1] - corners[cut.side]);
        const Vec2& far_corner = corners[(cut.side + 3) % 4];
        const Vec2 to = far_corner + cut.far * (corners[cut.side + 2] - far_corner);
        const double length = (to - from).norm();
        std::vector<std::pair<double, double>> covered;
        for (const Wall& wall : walls) {
            if (std::abs(left_of(from, to, wall.from)) > least_side_ ||
                std::abs(left_of(from, to, wall.to)) > least_side_)
                continue;
            const double a = (wall.from - from).dot(to - from) / length;
            const double b = (wall.to - from).dot(to - from) / length;
            covered.emplace_back(std::min(a, b), std::max(a, b));
        }
        std::sort(covered.begin(), covered.end());
        double sum = 0, reached = 0;
        for (const auto& [start, end] : covered) {
            sum += std::max(0.0, std::min(end, length) - std::max(start, reached));
            reached = std::max(reached, end);
        }
        return sum / length;
    }

    std::array<Quad, 2> parts_of(const Quad& quad, const Cut& cut) {
        const std::size_t i = cut.side;
        const auto between = [&](std::size_t from, std::size_t to, double share) {
            return vertex_at(quad.vertex[from] + share * (quad.vertex[to] - quad.vertex[from]));
        };
        const Vec3 near = between(i, i + 1, cut.near);
        const Vec3 far = between((i + 3) % 4, i + 2, cut.far);
        std::array<Quad, 2> parts = {quad, quad};
        parts[0].vertex[i + 1] = near;
        parts[0].vertex[i + 2] = far;
        parts[1].vertex[i] = near;
        parts[1].vertex[(i + 3) % 4] = far;
        return parts;
    }

    /// The vertex of a piece in this place. A wall that crosses another cuts the pieces on both
    /// sides of it, each by itself: both must end in the same vertex.
    Vec3 vertex_at(const Vec3& place) {
        for (const Vec3& vertex : vertices_)
            if ((vertex - place).norm() <= tolerance_) return vertex;
        vertices_.push_back(place);
        return place;
    }

    Vec3 origin_, along_, across_;
    double tolerance_;
    WallCutRule rule_;
    double least_side_ = 0;       ///< [m]
    std::vector<Vec3> vertices_;  ///< corners of pieces
    bool unfinished_ = false;
};

}  // namespace

CutAlongWalls cut_along_walls(const std::vector<SceneQuad>& quads, const WallCutRule& rule) {
    const std::vector<Quad> shapes = quads_of(quads);
    const double tolerance = weld(shapes).tolerance;
    const WallContacts contacts(shapes, tolerance);
    double area = 0;
    for (const Quad& quad : shapes)
        area += quad.area();
    CutAlongWalls result;
    for (std::size_t i = 0; i < quads.size(); ++i) {
        if (shapes[i].area() < rule.least_area * area) {
            result.quads.push_back(quads[i]);
            continue;
        }
        QuadCutter cutter(shapes[i], tolerance, rule);
        const std::vector<Quad> pieces = cutter.cut(shapes[i], contacts.on(static_cast<int>(i)));
        if (cutter.unfinished()) result.unfinished.add(quads[i].line);
        if (pieces.size() > 1) {
            ++result.cut;
            result.pieces += static_cast<int>(pieces.size());
        }
        for (const Quad& piece : pieces) {
            result.quads.push_back(quads[i]);
            result.quads.back().quad = piece;
        }
    }
    return result;
}

}  // namespace lightwell
