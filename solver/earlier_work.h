#pragma once

#include "solver/transport/link_records.h"

namespace lightwell {

/// What computing an operator leaves behind for a tighter one of the same scene.
struct EarlierWork {
    double cell_size = 0;  ///< of the cells that the links are between [m]; 0: there are none
    LinkRecords links;
};

}  // namespace lightwell
