#include "runtime/projection/edge_shares.h"

#include <array>

namespace lightwell {

namespace {

/// A cell that a single edge runs through is cut along it exactly, if it is so small a share of its
/// distance that the middle of a piece speaks for the piece.
constexpr float largest_share_to_cut = 0.2F;

}  // namespace

/// What gets through to a part of a cell past the shadows listed, after at most `cuts` cuts in
/// four for the sake of edges and `more` for the sake of nearness.
EdgeShares::Share EdgeShares::visible_share(const FourPoints& corners, const std::uint32_t* begin,
                                            const std::uint32_t* end, int cuts, int more) {
    ShadowEdges edges;
    for (const std::uint32_t* k = begin; k != end; ++k) {
        std::array<Straddle, ShadowPlanes::most_planes> found;
        Cover cover = Cover::none;
        const int count = planes_[*k].straddling(corners, tolerance_, cover, found.data());
        if (cover == Cover::all) return {0, whole(corners)};
        if (cover == Cover::part) edges.add(found.data(), count);
    }
    if (edges.is_closed()) return {0, whole(corners)};
    if (edges.are_none()) {
        const float all = whole(corners);
        return {all, all};
    }
    const bool is_small = kernel_.is_smooth(corners, squared_size(corners), largest_share_to_cut);
    if (edges.is_one() && (is_small || more == 0)) return cut(corners, edges.first());
    if (!edges.is_one() && cuts == 0) return sampled(corners, begin, end);
    Share sum;
    for (int q = 0; q < 4; ++q) {
        const Share part = edges.is_one()
                               ? visible_share(quarter(corners, q), begin, end, cuts, more - 1)
                               : visible_share(quarter(corners, q), begin, end, cuts - 1, more);
        sum.visible += part.visible;
        sum.whole += part.whole;
    }
    return sum;
}

EdgeShares::Share EdgeShares::cut(const FourPoints& corners, const Straddle& straddle) const {
    const OuterPart outer = outer_part(corners, straddle.height);
    const float all = whole(corners);
    if (!(outer.share > 0)) return {0, all};
    const Eigen::Vector3f middle = centroid(corners);
    FourPoints points;
    points.x << outer.centroid[0], middle[0], middle[0], middle[0];
    points.y << outer.centroid[1], middle[1], middle[1], middle[1];
    points.z << outer.centroid[2], middle[2], middle[2], middle[2];
    const Eigen::Array4f light = kernel_.at(points);
    if (!(light[1] > 0)) return {all * outer.share, all};
    return {std::min(all, all * outer.share * light[0] / light[1]), all};
}

/// Four rays.
EdgeShares::Share EdgeShares::sampled(const FourPoints& corners, const std::uint32_t* begin,
                                      const std::uint32_t* end) {
    const FourPoints points = quarter_centres(corners);
    Eigen::Array4f open = Eigen::Array4f::Ones();
    for (const std::uint32_t* k = begin; k != end; ++k)
        open = (1.0F - planes_[*k].hides(points)).min(open);
    rays_ += 4;
    const Eigen::Array4f light = kernel_.at(points);
    const float all = whole(corners), sum = light.sum();
    if (!(sum > 0)) return {0, all};
    return {all * (light * open).sum() / sum, all};
}

float EdgeShares::whole(const FourPoints& corners) const {
    if (!kernel_.is_smooth(corners, squared_size(corners))) {
        Quad quad;
        for (int k = 0; k < 4; ++k)
            quad.vertex[static_cast<std::size_t>(k)] = corners[k].cast<double>() + cells_.centre();
        return kernel_.exact_flux(quad);
    }
    return 0.25F * area(corners) * kernel_.at(quarter_centres(corners)).sum();
}

}  // namespace lightwell
