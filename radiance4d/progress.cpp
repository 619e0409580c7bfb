#include "radiance4d/progress.h"

#include "radiance4d/failure.h"

namespace lightwell {

void Progress::check() const {
    if (stop_requested && stop_requested()) throw Interrupted("stopped on request");
}

}  // namespace lightwell
