#include "runtime/outgoing/texture_borders.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

namespace lightwell {

namespace {

/// How far apart the planes of neighbours may be, relative to their size.
constexpr double relative_tolerance = 1e-6;

/// How high over the plane, as a share of a texel, it is looked whether something stands on it.
constexpr double part_to_lift = 0.1;

bool are_coplanar(const Quad& a, const Quad& b) {
    const Vec3 normal = a.normal();
    const double size = (a.vertex[2] - a.vertex[0]).norm() + (b.vertex[2] - b.vertex[0]).norm();
    return normal.dot(b.normal()) > 1 - relative_tolerance &&
           std::all_of(b.vertex.begin(), b.vertex.end(), [&](const Vec3& vertex) {
               return std::abs(normal.dot(vertex - a.vertex[0])) <= relative_tolerance * size;
           });
}

Eigen::AlignedBox3d box_of(const Quad& quad) {
    Eigen::AlignedBox3d box;
    for (const Vec3& vertex : quad.vertex)
        box.extend(vertex);
    return box;
}

}  // namespace

TextureBorders::TextureBorders(const RadianceSpace& space, const TextureAtlas& atlas,
                               const std::function<bool(std::size_t, std::size_t)>& goes_on) {
    std::vector<Eigen::AlignedBox3d> boxes;
    std::vector<Quad> quads;
    for (const Element& element : space.elements()) {
        boxes.push_back(box_of(element.geometry));
        quads.push_back(element.geometry);
    }
    const Visibility visibility(quads);
    for (std::size_t e = 0; e < boxes.size(); ++e) {
        const Quad& quad = space.element(e).geometry;
        const TextureSize& size = atlas.place(e).size;
        const double reach =
            (quad.vertex[2] - quad.vertex[0]).norm() / std::min(size.columns, size.rows);
        std::vector<std::size_t> candidates;
        for (std::size_t other = 0; other < boxes.size(); ++other)
            if (other != e && boxes[e].squaredExteriorDistance(boxes[other]) <= reach * reach &&
                goes_on(e, other) && are_coplanar(quad, space.element(other).geometry))
                candidates.push_back(other);
        bordered_.push_back(border_of(space, size, e, candidates, visibility));
    }
}

TextureBorders::Bordered TextureBorders::border_of(const RadianceSpace& space,
                                                   const TextureSize& size, std::size_t e,
                                                   const std::vector<std::size_t>& candidates,
                                                   const Visibility& visibility) {
    const Quad& quad = space.element(e).geometry;
    const auto centre = [&](int column, int row) {
        return quad.point((column + 0.5) / size.columns, (row + 0.5) / size.rows);
    };
    const auto stands_between = [&](const Vec3& inside, const Vec3& outside) {
        const Vec3 lift = part_to_lift * (outside - inside).norm() * quad.normal();
        return visibility.occluded(inside + lift, free_point, outside + lift, free_point);
    };
    Bordered bordered;
    const auto add = [&](int column, int row, int to_column, int to_row) {
        Texel texel{column, row, e, 0, 0, to_column, to_row};
        const Vec3 point = centre(column, row);
        const Vec3 last = centre(column + to_column, row + to_row);
        for (const std::size_t other : candidates) {
            const Vec2 uv = space.element(other).geometry.parameters(point);
            if (!((uv.array() >= 0).all() && (uv.array() <= 1).all())) continue;
            if (stands_between(last, point)) continue;
            texel.neighbour = other;
            texel.u = uv[0];
            texel.v = uv[1];
            std::vector<std::size_t>& known = bordered.neighbours;
            if (std::find(known.begin(), known.end(), other) == known.end()) known.push_back(other);
            break;
        }
        bordered.texels.push_back(texel);
    };
    const auto inwards = [](int at) { return at < 0 ? 1 : -1; };
    for (int column = 0; column < size.columns; ++column)
        for (const int row : {-1, size.rows})
            add(column, row, 0, inwards(row));
    std::array<bool, 2> has_neighbour = {false, false};  // left and right
    for (int row = 0; row < size.rows; ++row)
        for (const int column : {-1, size.columns}) {
            add(column, row, inwards(column), 0);
            if (bordered.texels.back().neighbour != e) has_neighbour[column < 0 ? 0 : 1] = true;
        }
    // Corners last: they continue the side that they share with a neighbour, as it does itself.
    for (const int row : {-1, size.rows})
        for (const int column : {-1, size.columns})
            if (has_neighbour[column < 0 ? 0 : 1])
                add(column, row, 0, inwards(row));
            else
                add(column, row, inwards(column), 0);
    return bordered;
}

void TextureBorders::fill(std::size_t e, TextureAtlas& atlas) const {
    const TextureSize& size = atlas.place(e).size;
    // Two steps on, but not beyond the texture.
    const auto on = [](int at, int step, int count) {
        return step == 0 ? at : std::clamp(at + 2 * step, 0, count - 1);
    };
    for (const Texel& border : bordered_[e].texels) {
        Packed light;
        if (border.neighbour != e) {
            light = atlas.bilinear_inside(border.neighbour, border.u, border.v);
        } else {
            const Packed last =
                atlas.texel(e, border.column + border.to_column, border.row + border.to_row);
            const Packed before = atlas.texel(e, on(border.column, border.to_column, size.columns),
                                              on(border.row, border.to_row, size.rows));
            light = (2.0F * last - before).max(0.0F).min(2.0F * last);
        }
        atlas.texel(e, border.column, border.row) = light;
    }
}

}  // namespace lightwell
