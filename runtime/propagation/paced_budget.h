#pragma once

#include <cstdint>

namespace lightwell {

/// How many coefficients a frame may multiply so that it takes about a given time: what one takes
/// is learnt from the frames before.
class PacedBudget {
  public:
    /// For UpdateOptions::budget, at least 1.
    /// @param seconds  that the product may take, positive
    std::uint32_t budget(double seconds) const;
    /// What a product took. Those of few coefficients say little, since what a frame takes whatever
    /// it multiplies is then the larger part; they are passed over.
    void took(std::uint32_t coefficients, double seconds);

  private:
    double seconds_each_ = 1e-6;
};

}  // namespace lightwell
