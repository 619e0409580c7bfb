#include "solver/reading/box_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace lightwell {

namespace {
constexpr int boxes_in_leaf = 4;
}

Box box_around(const Quad& quad) {
    Box box;
    for (const Vec3& corner : quad.vertex)
        box.extend(corner);
    return box;
}

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (boxes_.empty()) return;
    nodes_.push_back({Box(), -1, 0, static_cast<int>(boxes_.size())});
    // Nodes are appended as they are split, so this visits all of them without recursion.
    for (std::size_t node = 0; node < nodes_.size(); ++node)
        split(static_cast<int>(node));
}

void BoxTree::split(int node) {
    Node& parent = nodes_[static_cast<std::size_t>(node)];
    Box centres;
    for (int i = parent.begin; i < parent.end; ++i) {
        const Box& box = boxes_[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
        parent.box.extend(box);
        centres.extend(box.center());
    }
    if (parent.end - parent.begin <= boxes_in_leaf) return;
    int axis = 0;
    centres.sizes().maxCoeff(&axis);
    const int middle = parent.begin + (parent.end - parent.begin) / 2;
    std::nth_element(order_.begin() + parent.begin, order_.begin() + middle,
                     order_.begin() + parent.end, [&](int a, int b) {
                         const double x = boxes_[static_cast<std::size_t>(a)].center()[axis];
                         const double y = boxes_[static_cast<std::size_t>(b)].center()[axis];
                         return std::pair(x, a) < std::pair(y, b);
                     });
    const Node left{Box(), -1, parent.begin, middle}, right{Box(), -1, middle, parent.end};
    parent.left = static_cast<int>(nodes_.size());
    nodes_.push_back(left);
    nodes_.push_back(right);
}

void BoxTree::visit_meeting(const Box& region, const std::function<bool(int)>& visit) const {
    if (nodes_.empty()) return;
    std::vector<int> waiting = {0};
    while (!waiting.empty()) {
        const Node& node = nodes_[static_cast<std::size_t>(waiting.back())];
        waiting.pop_back();
        if (!node.box.intersects(region)) continue;
        if (node.left >= 0) {
            waiting.push_back(node.left + 1);
            waiting.push_back(node.left);
            continue;
        }
        for (int i = node.begin; i < node.end; ++i) {
            const int box = order_[static_cast<std::size_t>(i)];
            if (boxes_[static_cast<std::size_t>(box)].intersects(region) && !visit(box)) return;
        }
    }
}

}  // namespace lightwell
