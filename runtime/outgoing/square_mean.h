#pragma once

#include <functional>
#include <vector>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// The mean of a function over the unit square from about strata^2 values: half of them are spread
/// evenly, the others go where those differ from their neighbours, so that what is small and bright
/// or has an edge gets most (two-stage sampling with Neyman's allocation: a stratum deserves points
/// in proportion to the deviation within it). The points depend on the function and on nothing
/// else.
class SquareMean {
  public:
    using Function = std::function<Rgb(const Vec2&)>;

    /// @param strata at least 1
    explicit SquareMean(int strata);

    Rgb of(const Function& function) const;

  private:
    int side_;                 ///< strata of the first stage along either side
    int second_;               ///< points of the second stage
    std::vector<Vec2> point_;  ///< of each stratum of the first stage, row by row
};

}  // namespace lightwell
