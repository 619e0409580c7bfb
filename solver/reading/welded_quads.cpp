#include "solver/reading/welded_quads.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "solver/reading/box_tree.h"

namespace lightwell {

namespace {

constexpr double share_of_diagonal = 1e-6;

/// Places by cells of a grid. A cell is many tolerances wide and the grid starts at an odd place,
/// so that a point's neighbourhood is nearly always in one cell.
class Welder {
  public:
    Welder(const Box& bounds, double tolerance, std::vector<Vec3>& vertices)
        : tolerance_(tolerance),
          cell_(64 * tolerance),
          origin_(bounds.min() - Vec3(0.618, 0.414, 0.732) * cell_),
          vertices_(vertices) {}

    int vertex_at(const Vec3& place) {
        const Vec3 reach = Vec3::Constant(tolerance_);
        const auto low = cell_of(place - reach), high = cell_of(place + reach);
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t z = low[2]; z <= high[2]; ++z) {
                    const auto found = cells_.find(key(x, y, z));
                    if (found == cells_.end()) continue;
                    for (const int vertex : found->second)
                        if ((vertices_[static_cast<std::size_t>(vertex)] - place).norm() <=
                            tolerance_)
                            return vertex;
                }
        const int vertex = static_cast<int>(vertices_.size());
        vertices_.push_back(place);
        const auto cell = cell_of(place);
        cells_[key(cell[0], cell[1], cell[2])].push_back(vertex);
        return vertex;
    }

  private:
    std::array<std::int64_t, 3> cell_of(const Vec3& place) const {
        const Vec3 cell = ((place - origin_) / cell_).array().floor();
        return {static_cast<std::int64_t>(cell[0]), static_cast<std::int64_t>(cell[1]),
                static_cast<std::int64_t>(cell[2])};
    }
    /// The diagonal is at most 1e6 / 64 cells long, so 20 bits an axis suffice.
    static std::int64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
        return (x << 40) ^ (y << 20) ^ z;
    }

    double tolerance_, cell_;
    Vec3 origin_;
    std::vector<Vec3>& vertices_;
    std::unordered_map<std::int64_t, std::vector<int>> cells_;
};

}  // namespace

WeldedQuads weld(const std::vector<Quad>& quads) {
    Box bounds;
    for (const Quad& quad : quads)
        bounds.extend(box_around(quad));
    WeldedQuads welded;
    welded.tolerance = quads.empty() ? 0 : share_of_diagonal * bounds.diagonal().norm();
    if (!(welded.tolerance > 0)) welded.tolerance = 1;  // all in one place, or no quads at all
    Welder welder(bounds, welded.tolerance, welded.vertices);
    for (const Quad& quad : quads) {
        std::array<int, 4> corners{};
        for (std::size_t i = 0; i < 4; ++i)
            corners[i] = welder.vertex_at(quad.vertex[i]);
        welded.corners.push_back(corners);
    }
    return welded;
}

}  // namespace lightwell
