#pragma once

#include "solver/transport/link_records.h"

namespace lightwell {

/// What computing an operator leaves behind for a tighter one of the same scene.
struct EarlierWork {
    /// Of the cells that the links are between [m] (see Settings); 0: there are none.
    double cell_size = 0, gap_cell_size = 0;
    LinkRecords links;
};

}  // namespace lightwell
