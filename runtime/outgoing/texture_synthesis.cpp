#include "runtime/outgoing/texture_synthesis.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

/// How far apart the planes of neighbours may be, relative to their size.
constexpr double relative_tolerance = 1e-6;

/// Finest level, by element, on which the operator gives any coefficient.
std::vector<int> levels_given(const GlobalTransport& transport) {
    std::vector<int> levels(transport.space.elements().size(), 0);
    for (const TransportOperator& channel : transport.indirect)
        for (const std::uint32_t row : channel.row) {
            const std::size_t e = transport.space.element_of(row);
            const Element& element = transport.space.element(e);
            const std::uint32_t function = (row - element.first) / element.angle.functions();
            // A wavelet varies among the children of its support.
            if (function > 0)
                levels[e] =
                    std::max(levels[e], element.space.tree().level_of_function(function) + 1);
        }
    return levels;
}

/// Splits along u and v down to a level.
TextureSize texels_of(const CellTree& tree, int level) {
    TextureSize size;
    for (int l = 0; l < level; ++l) {
        const Split split = tree.splits()[static_cast<std::size_t>(l)];
        if (split != Split::v) size.columns *= 2;
        if (split != Split::u) size.rows *= 2;
    }
    return size;
}

/// Whether all of a cell is buried.
std::vector<char> buried_cells(const Element& element, int level) {
    const CellTree& tree = element.space.tree();
    std::vector<char> buried(tree.cells(level), element.open.empty() ? 0 : 1);
    const std::uint32_t finest = tree.functions() / tree.cells(level);
    for (std::size_t m = 0; m < element.open.size(); ++m)
        if (element.open[m] != 0) buried[m / finest] = 0;
    return buried;
}

bool are_coplanar(const Quad& a, const Quad& b) {
    const Vec3 normal = a.normal();
    const double size = (a.vertex[2] - a.vertex[0]).norm() + (b.vertex[2] - b.vertex[0]).norm();
    return normal.dot(b.normal()) > 1 - relative_tolerance &&
           std::all_of(b.vertex.begin(), b.vertex.end(), [&](const Vec3& vertex) {
               return std::abs(normal.dot(vertex - a.vertex[0])) <= relative_tolerance * size;
           });
}

bool are_close(const Quad& a, const Quad& b, double reach) {
    Eigen::AlignedBox3d first, second;
    for (std::size_t k = 0; k < 4; ++k) {
        first.extend(a.vertex[k]);
        second.extend(b.vertex[k]);
    }
    return first.squaredExteriorDistance(second) <= reach * reach;
}

}  // namespace

std::vector<TextureSynthesis::TexturedElement> TextureSynthesis::textured(
    const GlobalTransport& transport) {
    const std::vector<int> levels = levels_given(transport);
    std::vector<TexturedElement> result;
    for (std::size_t e = 0; e < transport.space.elements().size(); ++e) {
        const Element& element = transport.space.element(e);
        const CellTree& tree = element.space.tree();
        TexturedElement textured{PackedHaar(element.space),
                                 element.first,
                                 element.functions(),
                                 element.angle.functions(),
                                 levels[e],
                                 {},
                                 {},
                                 {},
                                 {},
                                 {},
                                 {}};
        textured.scaling = PackedField::Zero(4, tree.cells(levels[e]));
        const TextureSize size = texels_of(tree, levels[e]);
        std::vector<std::uint32_t> cell_at(tree.cells(levels[e]));
        for (std::uint32_t m = 0; m < tree.cells(levels[e]); ++m) {
            const Cell cell{levels[e], m};
            const ParameterRect rect = tree.rect(cell);
            const int column = static_cast<int>(0.5 * (rect.u0 + rect.u1) * size.columns);
            const int row = static_cast<int>(0.5 * (rect.v0 + rect.v1) * size.rows);
            textured.texel.emplace_back(column, row);
            cell_at[static_cast<std::size_t>(row) * static_cast<std::size_t>(size.columns) +
                    static_cast<std::size_t>(column)] = m;
            textured.to_lux.push_back(
                static_cast<float>(M_PI / std::sqrt(element.space.area(cell))));
        }
        // Ring by ring from the open cells.
        std::vector<char> unknown = buried_cells(element, levels[e]);
        for (bool grows = true; grows;) {
            grows = false;
            std::vector<char> next = unknown;
            for (std::uint32_t m = 0; m < unknown.size(); ++m) {
                if (unknown[m] == 0) continue;
                BuriedTexel texel{m, {}};
                const auto [column, row] = textured.texel[m];
                for (int y = std::max(0, row - 1); y <= std::min(size.rows - 1, row + 1); ++y)
                    for (int x = std::max(0, column - 1);
                         x <= std::min(size.columns - 1, column + 1); ++x) {
                        const std::uint32_t at =
                            cell_at[static_cast<std::size_t>(y) *
                                        static_cast<std::size_t>(size.columns) +
                                    static_cast<std::size_t>(x)];
                        if (unknown[at] == 0) texel.from.push_back(at);
                    }
                if (texel.from.empty()) continue;
                textured.buried.push_back(std::move(texel));
                next[m] = 0;
                grows = true;
            }
            unknown = std::move(next);
        }
        result.push_back(std::move(textured));
    }
    return result;
}

std::vector<TextureSize> TextureSynthesis::sizes(const std::vector<TexturedElement>& elements) {
    std::vector<TextureSize> result;
    result.reserve(elements.size());
    for (const TexturedElement& element : elements)
        result.push_back(texels_of(element.haar.tree(), element.level));
    return result;
}

TextureSynthesis::TextureSynthesis(const GlobalTransport& transport)
    : elements_(textured(transport)),
      atlas_(sizes(elements_)),
      shown_(PackedField::Zero(4, transport.space.functions())),
      changed_(elements_.size()) {
    find_borders(transport.space);
}

void TextureSynthesis::find_borders(const RadianceSpace& space) {
    for (std::size_t e = 0; e < elements_.size(); ++e) {
        const Quad& quad = space.element(e).geometry;
        const TextureSize& size = atlas_.place(e).size;
        const double reach =
            (quad.vertex[2] - quad.vertex[0]).norm() / std::min(size.columns, size.rows);
        std::vector<std::size_t> candidates;
        for (std::size_t other = 0; other < elements_.size(); ++other)
            if (other != e && are_close(quad, space.element(other).geometry, reach) &&
                are_coplanar(quad, space.element(other).geometry))
                candidates.push_back(other);
        TexturedElement& element = elements_[e];
        const auto add = [&](int column, int row, int to_column, int to_row) {
            BorderTexel texel{column, row, e, 0, 0, to_column, to_row};
            const Vec3 point = quad.point((column + 0.5) / size.columns, (row + 0.5) / size.rows);
            for (const std::size_t other : candidates) {
                const Vec2 uv = space.element(other).geometry.parameters(point);
                if (!((uv.array() >= 0).all() && (uv.array() <= 1).all())) continue;
                texel.neighbour = other;
                texel.u = uv[0];
                texel.v = uv[1];
                if (std::find(element.neighbours.begin(), element.neighbours.end(), other) ==
                    element.neighbours.end())
                    element.neighbours.push_back(other);
                break;
            }
            element.border.push_back(texel);
        };
        const auto inwards = [](int at) { return at < 0 ? 1 : -1; };
        for (int column = 0; column < size.columns; ++column)
            for (const int row : {-1, size.rows})
                add(column, row, 0, inwards(row));
        std::array<bool, 2> has_neighbour = {false, false};  // left and right
        for (int row = 0; row < size.rows; ++row)
            for (const int column : {-1, size.columns}) {
                add(column, row, inwards(column), 0);
                if (element.border.back().neighbour != e) has_neighbour[column < 0 ? 0 : 1] = true;
            }
        // Corners last: they continue the side that they share with a neighbour, as it does itself.
        for (const int row : {-1, size.rows})
            for (const int column : {-1, size.columns})
                if (has_neighbour[column < 0 ? 0 : 1])
                    add(column, row, 0, inwards(row));
                else
                    add(column, row, inwards(column), 0);
    }
}

std::size_t TextureSynthesis::synthesise(const PackedField& field) {
    LIGHTWELL_CHECK_OP(field.cols(), ==, shown_.cols());
    std::atomic<std::size_t> count{0};
    tbb::parallel_for(std::size_t{0}, elements_.size(), [&](std::size_t e) {
        const TexturedElement& element = elements_[e];
        auto shown = shown_.middleCols(element.first, element.functions);
        const auto wanted = field.middleCols(element.first, element.functions);
        changed_[e] = (shown != wanted).any() ? 1 : 0;
        if (changed_[e] == 0) return;
        shown = wanted;
        fill_texture(e, field);
        ++count;
    });
    tbb::parallel_for(std::size_t{0}, elements_.size(), [&](std::size_t e) {
        const std::vector<std::size_t>& neighbours = elements_[e].neighbours;
        const bool is_touched = std::any_of(neighbours.begin(), neighbours.end(),
                                            [&](std::size_t n) { return changed_[n] != 0; });
        if (changed_[e] != 0 || is_touched) fill_border(e);
    });
    return count;
}

void TextureSynthesis::fill_texture(std::size_t e, const PackedField& field) {
    TexturedElement& element = elements_[e];
    PackedField& scaling = element.scaling;
    element.haar.synthesise(field, element.first, element.level, scaling, element.angles);
    for (std::size_t m = 0; m < element.to_lux.size(); ++m)
        scaling.col(static_cast<Eigen::Index>(m)) *= element.to_lux[m];
    for (const BuriedTexel& buried : element.buried) {
        Packed sum = Packed::Zero();
        for (const std::uint32_t from : buried.from)
            sum += scaling.col(from);
        scaling.col(buried.cell) = sum / static_cast<float>(buried.from.size());
    }
    for (std::size_t m = 0; m < element.texel.size(); ++m)
        atlas_.texel(e, element.texel[m].first, element.texel[m].second) =
            scaling.col(static_cast<Eigen::Index>(m)).max(0.0F);
}

void TextureSynthesis::fill_border(std::size_t e) {
    const TextureSize& size = atlas_.place(e).size;
    // Two steps on, but not beyond the texture.
    const auto on = [](int at, int step, int count) {
        return step == 0 ? at : std::clamp(at + 2 * step, 0, count - 1);
    };
    for (const BorderTexel& border : elements_[e].border) {
        Packed light;
        if (border.neighbour != e) {
            light = atlas_.bilinear_inside(border.neighbour, border.u, border.v);
        } else {
            const Packed last =
                atlas_.texel(e, border.column + border.to_column, border.row + border.to_row);
            const Packed before = atlas_.texel(e, on(border.column, border.to_column, size.columns),
                                               on(border.row, border.to_row, size.rows));
            light = (2.0F * last - before).max(0.0F).min(2.0F * last);
        }
        atlas_.texel(e, border.column, border.row) = light;
    }
}

}  // namespace lightwell
