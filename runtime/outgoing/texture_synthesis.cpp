#include "runtime/outgoing/texture_synthesis.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <tbb/parallel_for.h>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

/// Rings of buried texels that carry on the light beside them: as many as filtering, and the rim's
/// continuation, look at. Further in it is dark, as in pictures that are gathered.
constexpr int rings = 2;

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
        for (int ring = 0; ring < rings; ++ring) {
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
            }
            unknown = std::move(next);
        }
        for (std::uint32_t m = 0; m < unknown.size(); ++m)
            if (unknown[m] != 0) textured.buried.push_back({m, {}});
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
      borders_(transport.space, atlas_, [](std::size_t, std::size_t) { return true; }),
      shown_(PackedField::Zero(4, transport.space.functions())),
      changed_(elements_.size()) {}

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
        const std::vector<std::size_t>& neighbours = borders_.neighbours(e);
        const bool is_touched = std::any_of(neighbours.begin(), neighbours.end(),
                                            [&](std::size_t n) { return changed_[n] != 0; });
        if (changed_[e] != 0 || is_touched) borders_.fill(e, atlas_);
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
        scaling.col(buried.cell) =
            sum / static_cast<float>(std::max<std::size_t>(1, buried.from.size()));
    }
    for (std::size_t m = 0; m < element.texel.size(); ++m)
        atlas_.texel(e, element.texel[m].first, element.texel[m].second) =
            scaling.col(static_cast<Eigen::Index>(m)).max(0.0F);
}

}  // namespace lightwell
