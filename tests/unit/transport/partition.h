#pragma once

#include <vector>

#include "solver/transport/link.h"

namespace lightwell::testing {

/// How many of a pair's links cover each pair of finest cells: receiver cells down, sender cells
/// across.
inline Eigen::MatrixXi covered(const std::vector<Element>& elements, const PairLinks& pair) {
    const CellTree& x = elements[pair.receiver].space.tree();
    const CellTree& y = elements[pair.sender].space.tree();
    Eigen::MatrixXi count = Eigen::MatrixXi::Zero(x.functions(), y.functions());
    for (const LinkValue& link : pair.links) {
        const Cell r = x.at(link.receiver), s = y.at(link.sender);
        const std::uint32_t rows = x.functions() / x.cells(r.level);
        const std::uint32_t columns = y.functions() / y.cells(s.level);
        count.block(r.index * rows, s.index * columns, rows, columns).array() += 1;
    }
    return count;
}

}  // namespace lightwell::testing
