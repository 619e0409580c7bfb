#include "radiance4d/operator/smooth_irradiance.h"

#include <algorithm>
#include <utility>

namespace lightwell {

namespace {

/// Rings of buried cells that carry on the light beside them: as many as the reconstruction of an
/// open cell looks at. Further in it is dark, as a ray into a gap that cells are too coarse for
/// would find it.
constexpr int rings = 2;

/// Gives buried cells values, ring by ring from the open ones, so that reconstruction does not pull
/// the open cells beside them down to the darkness that nobody sees.
class BuriedCells {
  public:
    BuriedCells(const Element& element, RadianceField& means)
        : tree_(element.space.tree()),
          columns_(static_cast<int>(tree_.columns())),
          rows_(static_cast<int>(tree_.rows())),
          means_(means) {
        for (const OpenMask mask : element.open)
            known_.push_back(mask != 0 ? 1 : 0);
    }

    void fill() {
        for (int ring = 0; ring < rings; ++ring) {
            std::vector<char> next = known_;
            for (int j = 0; j < rows_; ++j)
                for (int i = 0; i < columns_; ++i)
                    if (!is_known(i, j) && continues(i, j)) next[cell(i, j)] = 1;
            known_ = std::move(next);
        }
        for (int j = 0; j < rows_; ++j)
            for (int i = 0; i < columns_; ++i)
                if (!is_known(i, j)) means_.row(cell(i, j)).setZero();
    }

  private:
    std::uint32_t cell(int i, int j) const {
        return tree_.finest_at(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
    }
    bool is_known(int i, int j) const {
        return i >= 0 && j >= 0 && i < columns_ && j < rows_ && known_[cell(i, j)] != 0;
    }
    Rgb mean(int i, int j) const { return means_.row(cell(i, j)).transpose(); }

    /// Continues the eight lines that lead to a cell, linearly where two cells of one are known
    /// (light often grows towards a foot), but not beyond half or twice the nearer one; takes the
    /// mean. False if no neighbour is known.
    bool continues(int i, int j) {
        Rgb sum = Rgb::Zero();
        int count = 0;
        for (int b = -1; b <= 1; ++b) {
            for (int a = -1; a <= 1; ++a) {
                if (!is_known(i + a, j + b)) continue;  // the cell itself is not known
                const Rgb near = mean(i + a, j + b);
                sum +=
                    is_known(i + 2 * a, j + 2 * b)
                        ? Rgb((2 * near - mean(i + 2 * a, j + 2 * b)).max(0.5 * near).min(2 * near))
                        : near;
                ++count;
            }
        }
        if (count > 0) means_.row(cell(i, j)) = (sum / count).transpose();
        return count > 0;
    }

    const CellTree& tree_;
    int columns_;
    int rows_;
    RadianceField& means_;
    std::vector<char> known_;  // by finest cell
};

}  // namespace

std::vector<SmoothSurface> smooth_irradiance(const RadianceSpace& space,
                                             const RadianceField& field) {
    std::vector<SmoothSurface> surfaces;
    surfaces.reserve(space.elements().size());
    for (std::size_t e = 0; e < space.elements().size(); ++e)
        surfaces.push_back(smooth_irradiance(space, e, field));
    return surfaces;
}

SmoothSurface smooth_irradiance(const RadianceSpace& space, std::size_t element,
                                const RadianceField& field) {
    RadianceField means = cell_irradiance(space, element, field);
    if (!space.element(element).open.empty()) BuriedCells(space.element(element), means).fill();
    return {space.element(element).space.tree(), means};
}

}  // namespace lightwell
