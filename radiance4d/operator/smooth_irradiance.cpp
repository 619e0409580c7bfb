#include "radiance4d/operator/smooth_irradiance.h"

#include <algorithm>
#include <utility>

namespace lightwell {

namespace {

/// Gives buried cells the mean of their neighbours, ring by ring from the open ones, so that
/// reconstruction does not pull the open cells beside them down to the darkness that nobody sees.
void fill_buried(const Element& element, RadianceField& means) {
    if (element.open.empty()) return;
    const CellTree& tree = element.space.tree();
    const int columns = static_cast<int>(tree.columns()), rows = static_cast<int>(tree.rows());
    const auto cell = [&](int i, int j) {
        return tree.finest_at(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
    };
    std::vector<char> known(tree.functions());
    for (std::uint32_t m = 0; m < tree.functions(); ++m)
        known[m] = element.open[m] != 0 ? 1 : 0;
    for (bool changed = true; changed;) {
        changed = false;
        std::vector<char> next = known;
        for (int j = 0; j < rows; ++j) {
            for (int i = 0; i < columns; ++i) {
                if (known[cell(i, j)] != 0) continue;
                Rgb sum = Rgb::Zero();
                int count = 0;
                for (int b = std::max(0, j - 1); b <= std::min(rows - 1, j + 1); ++b)
                    for (int a = std::max(0, i - 1); a <= std::min(columns - 1, i + 1); ++a)
                        if (known[cell(a, b)] != 0) {
                            sum += means.row(cell(a, b)).transpose();
                            ++count;
                        }
                if (count == 0) continue;
                means.row(cell(i, j)) = (sum / count).transpose();
                next[cell(i, j)] = 1;
                changed = true;
            }
        }
        known = std::move(next);
    }
}

}  // namespace

std::vector<SmoothSurface> smooth_irradiance(const RadianceSpace& space,
                                             const RadianceField& field) {
    std::vector<SmoothSurface> surfaces;
    surfaces.reserve(space.elements().size());
    for (std::size_t e = 0; e < space.elements().size(); ++e) {
        RadianceField means = cell_irradiance(space, e, field);
        fill_buried(space.element(e), means);
        surfaces.emplace_back(space.element(e).space.tree(), means);
    }
    return surfaces;
}

}  // namespace lightwell
