#include "solver/transport/open_masks.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

#include "radiance4d/basis/direction_map.h"

namespace lightwell {

namespace {

/// Rays that look round from a sample: strata of the angular square along either side.
constexpr int looks_along = 4;
/// A neighbour nearer than this share of the cell's size covers a sample rather than lights it.
constexpr double cover_share = 0.25;
/// It covers if it is about parallel to the surface: the cosine between their normals is above
/// this. A wall that stands on the surface does not.
constexpr double parallel = 0.8;
/// A sample that sees less than this many of its looks_along^2 rays go free is buried: in the gap
/// under a lamp's rim it is far darker than the open part whose mean it would be shown.
constexpr int least_open = 5;

/// Heights below this share of a quad's size are in its plane.
constexpr double coplanar_share = 1e-6;

/// Whether a point of the quad's plane lies inside its outline.
bool holds(const Quad& quad, const Vec3& point) {
    const Vec3 n = quad.normal();
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 edge = quad.vertex[(k + 1) % 4] - quad.vertex[k];
        if (n.cross(edge).dot(point - quad.vertex[k]) < 0) return false;
    }
    return true;
}

/// Tells open samples of one element from buried ones.
class SampleTest {
  public:
    SampleTest(const Element& element, const std::vector<Quad>& quads,
               const std::vector<char>& takes_part, const Visibility& visibility)
        : element_(element),
          quads_(quads),
          takes_part_(takes_part),
          visibility_(visibility),
          frame_(local_frame(element.geometry)) {
        const CellTree& tree = element.space.tree();
        const Quad cell = element.cell({tree.levels(), 0});
        cover_ = cover_share * (cell.vertex[2] - cell.vertex[0]).norm();
        for (int i = 0; i < looks_along; ++i)
            for (int j = 0; j < looks_along; ++j)
                looks_.push_back(frame_ * direction_from_square(
                                              {(i + 0.5) / looks_along, (j + 0.5) / looks_along}));
    }

    /// @param covers  earlier quads of the same plane that overlap the element
    void set_covers(std::vector<Quad> covers) { covers_ = std::move(covers); }
    bool is_covered_in_part() const { return !covers_.empty(); }

    /// Whether any light gets there.
    bool is_reached(double u, double v) { return sees(u, v, 1); }
    /// Whether enough of it does.
    bool is_open(double u, double v) { return sees(u, v, least_open); }

    std::uint64_t rays = 0;

  private:
    /// Whether at least so many rays from (u,v) go free.
    bool sees(double u, double v, int wanted) {
        const Vec3 point = element_.geometry.point(u, v);
        for (const Quad& cover : covers_)
            if (holds(cover, point)) return false;
        for (const Vec3& direction : looks_) {
            ++rays;
            if (is_free(visibility_.nearest(point, element_.quad, direction)) && --wanted == 0)
                return true;
        }
        return false;
    }

    bool is_free(const Hit& hit) const {
        if (!hit) return true;
        const auto quad = static_cast<std::size_t>(hit.quad);
        if (takes_part_[2 * quad + (hit.front ? 0 : 1)] == 0) return false;
        return hit.distance > cover_ ||
               std::abs(quads_[quad].normal().dot(element_.geometry.normal())) < parallel;
    }

    const Element& element_;
    const std::vector<Quad>& quads_;
    const std::vector<char>& takes_part_;
    const Visibility& visibility_;
    Eigen::Matrix3d frame_;
    std::vector<Vec3> looks_;
    std::vector<Quad> covers_;
    double cover_ = 0;
};

/// Quads before the element's own, by number, that lie in its plane and overlap it.
std::vector<Quad> covers_of(const Element& element, const std::vector<Quad>& quads,
                            const OccluderTree& tree) {
    const Vec3 n = element.geometry.normal();
    const double size = (element.geometry.vertex[2] - element.geometry.vertex[0]).norm();
    const double tolerance = coplanar_share * size;
    Eigen::AlignedBox3d box;
    for (const Vec3& corner : element.geometry.vertex)
        box.extend(corner);
    box.min().array() -= tolerance;
    box.max().array() += tolerance;
    std::vector<int> near;
    tree.collect(ConvexRegion(box), near);
    std::vector<Quad> covers;
    for (const int q : near) {
        if (q >= element.quad) break;
        const Quad& other = quads[static_cast<std::size_t>(q)];
        const bool coplanar =
            std::all_of(other.vertex.begin(), other.vertex.end(), [&](const Vec3& corner) {
                return std::abs(n.dot(corner - element.geometry.vertex[0])) <= tolerance;
            });
        if (coplanar) covers.push_back(other);
    }
    return covers;
}

/// The corners of the finest cells, inset by a little so that they do not fall into the edge of a
/// wall; and the centres.
constexpr double inset = 1e-3;

std::vector<OpenMask> masks_of(const Element& element, SampleTest& test) {
    const CellTree& tree = element.space.tree();
    const std::uint32_t columns = tree.columns(), rows = tree.rows();
    // Look at shared corners once.
    std::vector<char> corner((columns + 1) * (rows + 1));
    for (std::uint32_t j = 0; j <= rows; ++j)
        for (std::uint32_t i = 0; i <= columns; ++i)
            corner[j * (columns + 1) + i] =
                test.is_reached(std::clamp(static_cast<double>(i) / columns, inset, 1 - inset),
                                std::clamp(static_cast<double>(j) / rows, inset, 1 - inset))
                    ? 1
                    : 0;
    std::vector<OpenMask> masks(tree.functions(), all_open);
    bool any = false;
    for (std::uint32_t j = 0; j < rows; ++j) {
        for (std::uint32_t i = 0; i < columns; ++i) {
            const int open = corner[j * (columns + 1) + i] + corner[j * (columns + 1) + i + 1] +
                             corner[(j + 1) * (columns + 1) + i] +
                             corner[(j + 1) * (columns + 1) + i + 1] +
                             (test.is_reached((i + 0.5) / columns, (j + 0.5) / rows) ? 1 : 0);
            if (open == 5) continue;
            OpenMask mask = 0;
            if (open > 0)
                for (unsigned bit = 0; bit < 64; ++bit)
                    if (test.is_open((i + (bit % 8 + 0.5) / 8) / columns,
                                     (j + (bit / 8 + 0.5) / 8) / rows))
                        mask |= OpenMask{1} << bit;
            masks[tree.finest_at(i, j)] = mask;
            any = any || mask != all_open;
        }
    }
    if (!any) masks.clear();
    return masks;
}

}  // namespace

void set_open_masks(const std::vector<Quad>& quads, const OccluderTree& tree,
                    const Visibility& visibility, std::vector<Element>& elements,
                    OracleCost& cost) {
    std::vector<char> takes_part(2 * static_cast<std::size_t>(visibility.quad_count()), 0);
    for (const Element& element : elements)
        takes_part[2 * static_cast<std::size_t>(element.quad) + (element.front ? 0 : 1)] = 1;
    std::atomic<std::uint64_t> rays{0};
    tbb::parallel_for(std::size_t{0}, elements.size(), [&](std::size_t e) {
        Element& element = elements[e];
        SampleTest test(element, quads, takes_part, visibility);
        test.set_covers(covers_of(element, quads, tree));
        // A quad that is one cell is too small to matter, unless something lies on it.
        if (element.space.tree().levels() == 0 && !test.is_covered_in_part()) return;
        std::vector<OpenMask> masks = masks_of(element, test);
        rays += test.rays;
        if (!masks.empty()) element.set_space(CellTree(element.space.tree()), std::move(masks));
    });
    cost.rays += rays;
}

}  // namespace lightwell
