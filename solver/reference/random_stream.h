#pragma once

#include <cstdint>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// Independent uniform numbers, one stream per key: what is drawn depends on the key alone, never
/// on which thread draws or when. The generator is splitmix64 (Steele, Lea, Flood 2014, "Fast
/// splittable pseudorandom number generators"); keys are absorbed by its finaliser.
class RandomStream {
  public:
    explicit RandomStream(std::uint64_t seed, std::uint64_t first = 0, std::uint64_t second = 0)
        : state_(mixed(mixed(mixed(seed + step_) ^ (first + step_)) ^ (second + 2 * step_))) {}

    std::uint64_t bits() { return mixed(state_ += step_); }
    /// Uniform in [0,1), a multiple of 2^-53.
    double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    /// Uniform in [0,1)^2.
    Vec2 uniform_pair() {
        const double first = uniform();
        return {first, uniform()};
    }
    /// Uniform in 0 ... count-1 (to within count/2^64).
    std::uint64_t below(std::uint64_t count) { return bits() % count; }

  private:
    static std::uint64_t mixed(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }
    static constexpr std::uint64_t step_ = 0x9e3779b97f4a7c15ULL;

    std::uint64_t state_;
};

}  // namespace lightwell
