#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace lightwell {

/// Points of [0,1)^4 that fill it evenly: the additive sequence on the generalised golden ratio
/// (Roberts 2018), from a start of its own for every support.
class EvenPoints4 {
  public:
    explicit EvenPoints4(std::uint64_t start) {
        for (std::size_t k = 0; k < 4; ++k)
            at_[k] = fraction(static_cast<double>(start % 65536) * step[3 - k] +
                              static_cast<double>(start / 65536) * step[k]);
    }
    const std::array<double, 4>& next() {
        for (std::size_t k = 0; k < 4; ++k)
            at_[k] = fraction(at_[k] + step[k]);
        return at_;
    }

  private:
    static constexpr std::array<double, 4> step = {0.85667488385450287, 0.73389185662718776,
                                                   0.62870672083239870, 0.53859725722360993};
    static double fraction(double x) { return x - std::floor(x); }

    std::array<double, 4> at_{};
};

}  // namespace lightwell
