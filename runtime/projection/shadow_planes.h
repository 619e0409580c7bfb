#pragma once

#include <array>

#include "radiance4d/scene/shadow.h"
#include "runtime/projection/four_points.h"

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

/// The edges of shadows that run through one part of a cell.
class ShadowEdges {
  public:
    /// The planes of one more shadow that run between the corners.
    void add(const Straddle* planes, int count) {
        if (count > 1) {
            is_complex_ = true;
            return;
        }
        for (std::size_t k = 0; k < known_; ++k) {
            // A silhouette is an edge of the face before it and of the one behind it alike.
            if (planes[0].is_same_line(edge_[k])) return;
            // Two shadows that meet along an edge of both leave nothing between them.
            if (planes[0].is_opposite(edge_[k])) is_closed_ = true;
        }
        if (known_ == edge_.size())
            is_complex_ = true;
        else
            edge_[known_++] = planes[0];
    }

    bool are_none() const { return known_ == 0 && !is_complex_; }
    bool is_one() const { return known_ == 1 && !is_complex_; }
    /// Whether two of the shadows cover all.
    bool is_closed() const { return is_closed_; }
    const Straddle& first() const { return edge_[0]; }

  private:
    std::array<Straddle, 4> edge_;
    std::size_t known_ = 0;
    bool is_complex_ = false, is_closed_ = false;
};

}  // namespace lightwell
