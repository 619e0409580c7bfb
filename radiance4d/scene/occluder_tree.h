#pragma once

#include <vector>

#include "radiance4d/scene/convex_region.h"

namespace lightwell {

/// A bounding-volume hierarchy over quads that answers, without rays, which of them reach into a
/// convex region. A query costs as much as there are quads in and about the region. Const after
/// construction; may be asked from many threads at once.
class OccluderTree {
  public:
    explicit OccluderTree(const std::vector<Quad>& quads);

    /// Puts into `found` (cleared first) the indices of all quads that the region does not miss, in
    /// ascending order.
    void collect(const ConvexRegion& region, std::vector<int>& found) const;

    /// As above, less two quads that never count (or free_point): those at the ends of what the
    /// region bounds.
    void collect(const ConvexRegion& region, int not_this, int nor_this,
                 std::vector<int>& found) const;

    int quad_count() const { return static_cast<int>(entries_.size()); }

  private:
    struct Entry {
        Quad quad;
        int index;
    };
    /// An inner node's first child follows it at once, the second is `second_child`; a leaf holds
    /// the entries [first, first + count).
    struct Node {
        Eigen::AlignedBox3d box;
        int second_child = 0;
        int first = 0;
        int count = 0;  ///< 0 for an inner node
    };

    void build(int first, int count);

    std::vector<Entry> entries_;
    std::vector<Node> nodes_;
};

}  // namespace lightwell
