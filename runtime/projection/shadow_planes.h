#pragma once

#include <array>

#include "radiance4d/scene/shadow.h"
#include "runtime/projection/element_cells.h"

namespace lightwell {

/// What stands between a lamp and a part of a surface.
enum class Cover { none, part, all };

/// A line across a quad, as the heights of its corners over a plane through the line, relative to
/// the largest; inside, in the shadow, they are positive. Two planes that meet the quad in the same
/// line have the same heights.
struct Straddle {
    Eigen::Array4f height;

    bool is_same_line(const Straddle& other) const { return is_zero(height - other.height); }
    /// The same line with its sides changed over.
    bool is_opposite(const Straddle& other) const { return is_zero(height + other.height); }

  private:
    static bool is_zero(const Eigen::Array4f& difference) {
        return difference.abs().maxCoeff() <= 2e-4F;
    }
};

/// What one quad hides from a lamp, as the up to five planes of its shadow, for tests of four
/// points at once.
class ShadowPlanes {
  public:
    static constexpr int most_planes = 5;

    /// @param origin  that of the points to be tested; the planes of a shadow begin at its apex
    ShadowPlanes(const Shadow& shadow, const Vec3& origin);

    /// How much of the quad with these corners is in shadow: nothing, if all corners lie outside of
    /// one plane, all of it if they lie inside of all; else perhaps a part. Corners within
    /// `tolerance` [m] of a plane count as what is more convenient.
    Cover cover(const FourPoints& corners, float tolerance) const;
    /// As above, and puts the heights over the planes that run between the corners into
    /// `straddles`, which has room for most_planes, if the answer is `part`. @return how many, else
    /// 0
    int straddling(const FourPoints& corners, float tolerance, Cover& cover,
                   Straddle* straddles) const;
    /// 1 for points in shadow, else 0.
    Eigen::Array4f hides(const FourPoints& points) const;

  private:
    Eigen::Array4f heights(int plane, const FourPoints& points) const;

    struct Side {
        float x, y, z, offset;
    };
    std::array<Side, most_planes> side_;
    int count_ = 0;
};

}  // namespace lightwell
