#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "runtime/projection/element_cells.h"
#include "runtime/projection/four_points.h"
#include "runtime/projection/light_kernel.h"
#include "runtime/projection/shadow_planes.h"

namespace lightwell {

/// What gets through from a lamp to cells that edges of shadows run through.
///
/// A part of a cell with a single edge is cut along it; one with several is cut in four again and
/// again, until rays to its quarters, tested against the few shadows listed, speak for the rest.
class EdgeShares {
  public:
    /// Flux on a part of a cell, up to a common factor: what gets through, and all of it.
    struct Share {
        float visible = 0, whole = 0;

        float ratio() const { return visible > 0 ? std::min(1.0F, visible / whole) : 0; }
    };

    /// Cuts in four for the sake of nearness, and at most for that of edges.
    static constexpr int most_cuts = 6;

    /// Keeps references to all.
    /// @param tolerance  how near to a shadow's plane a corner may lie and count as on it [m]
    /// @param rays       counts them
    EdgeShares(const ElementCells& cells, const LightKernel& kernel,
               const std::vector<ShadowPlanes>& planes, float tolerance, std::uint64_t& rays)
        : cells_(cells), kernel_(kernel), planes_(planes), tolerance_(tolerance), rays_(rays) {}

    /// @param begin,end  the shadows that may reach the part, as indices of planes
    /// @param cuts       in four, at most, where several edges run
    Share of(const FourPoints& corners, const std::uint32_t* begin, const std::uint32_t* end,
             int cuts) {
        return visible_share(corners, begin, end, cuts, most_cuts);
    }

  private:
    Share visible_share(const FourPoints& corners, const std::uint32_t* begin,
                        const std::uint32_t* end, int cuts, int more);
    Share cut(const FourPoints& corners, const Straddle& straddle) const;
    Share sampled(const FourPoints& corners, const std::uint32_t* begin, const std::uint32_t* end);
    float whole(const FourPoints& corners) const;

    const ElementCells& cells_;
    const LightKernel& kernel_;
    const std::vector<ShadowPlanes>& planes_;
    float tolerance_;
    std::uint64_t& rays_;
};

}  // namespace lightwell
