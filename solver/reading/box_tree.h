#pragma once

#include <functional>
#include <vector>

#include <Eigen/Geometry>

#include "radiance4d/scene/quad.h"

namespace lightwell {

using Box = Eigen::AlignedBox3d;

/// The box around a quad.
Box box_around(const Quad& quad);

/// Finds the boxes that meet a box, in time that grows with their number and the logarithm of the
/// number of all boxes. Boxes are halved at the median of their centres along the longest side.
class BoxTree {
  public:
    explicit BoxTree(std::vector<Box> boxes);

    /// Calls `visit` with the index of every box that meets `region` (touching is meeting), in an
    /// order that depends on the boxes alone. Stops when `visit` says false.
    void visit_meeting(const Box& region, const std::function<bool(int)>& visit) const;

  private:
    /// An inner node's children are left and left + 1; a leaf has a range of order_.
    struct Node {
        Box box;
        int left = -1;
        int begin = 0, end = 0;
    };
    void split(int node);

    std::vector<Box> boxes_;
    std::vector<int> order_;
    std::vector<Node> nodes_;
};

}  // namespace lightwell
