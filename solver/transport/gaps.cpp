#include "solver/transport/gaps.h"

#include <algorithm>
#include <limits>

#include <tbb/parallel_for.h>

#include "radiance4d/basis/direction_map.h"
#include "solver/transport/elements.h"

namespace lightwell {

namespace {

/// Bounds of a quad along the two axes of a plane.
struct Bounds {
    Bounds(const Quad& quad, const Eigen::Matrix3d& frame) {
        for (const Vec3& corner : quad.vertex) {
            const Vec2 at = (frame.transpose() * corner).head<2>();
            least = least.cwiseMin(at);
            most = most.cwiseMax(at);
        }
    }

    Vec2 least = Vec2::Constant(std::numeric_limits<double>::infinity());
    Vec2 most = -least;
};

}  // namespace

std::vector<Gap> gaps_between(const std::vector<Element>& elements, double highest) {
    constexpr double parallel = 0.999;       // cosine of 2.6 degrees
    constexpr double touching_share = 1e-4;  // of the elements' extents
    std::vector<Eigen::Matrix3d> frame;
    for (const Element& element : elements)
        frame.push_back(local_frame(element.geometry));
    std::vector<std::vector<Gap>> by_first(elements.size());
    tbb::parallel_for(std::size_t{0}, elements.size(), [&](std::size_t i) {
        const Quad& x = elements[i].geometry;
        const Vec3 normal = frame[i].col(2);
        const Bounds of_x(x, frame[i]);
        for (std::size_t j = i + 1; j < elements.size(); ++j) {
            if (normal.dot(frame[j].col(2)) > -parallel) continue;
            const Quad& y = elements[j].geometry;
            const double height = normal.dot(y.centre() - x.vertex[0]);
            if (!(height > 0) || height > highest) continue;
            const Bounds of_y(y, frame[i]);
            const Vec2 facing = of_x.most.cwiseMin(of_y.most) - of_x.least.cwiseMax(of_y.least);
            const double extent = (of_x.most - of_x.least).norm() + (of_y.most - of_y.least).norm();
            if (height < touching_share * extent || facing.minCoeff() < height) continue;
            by_first[i].push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j),
                                   height, 2 * facing.sum()});
        }
    });
    std::vector<Gap> all;
    for (const std::vector<Gap>& gaps : by_first)
        all.insert(all.end(), gaps.begin(), gaps.end());
    return all;
}

double gap_cell_size(const std::vector<Gap>& gaps, double cell_size, double area, double error) {
    // At a rim the irradiance falls to that in the gap within about its height. A cell of width c
    // on either side blurs it over c, which is a mean square error of edge^2 2 rim c / area, edge
    // relative to the irradiance's root mean square. In a Cornell box with a lamp 1 cm below the
    // ceiling edge was 0.28. Half of the squared error may come from there.
    constexpr double edge = 0.28, share = 0.7;
    double rims = 0;
    for (const Gap& gap : gaps)
        if (gap.height < cell_size) rims += gap.rim;
    const double allowed = share * error / edge;
    return rims > 0 ? allowed * allowed * area / (2 * rims)
                    : std::numeric_limits<double>::infinity();
}

void set_gap_cells(const std::vector<Gap>& gaps, double cell_size, double gap_cell_size,
                   int most_levels, std::vector<Element>& elements) {
    constexpr double heights = 2;
    std::vector<double> finest(elements.size(), cell_size);
    for (const Gap& gap : gaps) {
        const double wanted = std::max(heights * gap.height, gap_cell_size);
        for (const std::uint32_t e : {gap.first, gap.second})
            finest[e] = std::min(finest[e], wanted);
    }
    for (std::size_t e = 0; e < elements.size(); ++e)
        if (finest[e] < cell_size) set_cells(elements[e], finest[e], most_levels);
}

}  // namespace lightwell
