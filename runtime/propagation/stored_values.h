#pragma once

#include <cstdint>
#include <cstring>

#include <Eigen/Core>

namespace lightwell {

/// Numbers that the processor works on together (an extension that GCC and Clang share).
template <typename Number>
using Four __attribute__((vector_size(4 * sizeof(Number)))) = Number;

/// Four numbers from memory, wherever they lie.
template <typename Number>
Four<Number> four_at(const Number* numbers) {
    Four<Number> result;
    std::memcpy(&result, numbers, sizeof result);
    return result;
}

/// How the values of a column are held, each times the column's scale. `scale_for` gives the scale
/// for a column whose largest magnitude is `largest` > 0; `encoded` rounds value / scale; `decoded`
/// is its inverse but for that rounding, of one value or of four.

/// As the file has them.
struct SingleValue {
    using Stored = float;
    static float scale_for(float) { return 1; }
    static Stored encoded(float value) { return value; }
    static float decoded(Stored stored) { return stored; }
    static Four<float> decoded(Four<Stored> stored) { return stored; }
};

/// Half floats of 11 significant bits. The column is scaled so that its largest magnitude is close
/// to the largest half; what then is below the least normal half, 2^-30 of the largest, is zero, so
/// that subnormal numbers, which cost a processor a hundred cycles, never occur.
struct HalfValue {
    using Stored = std::uint16_t;
    static float scale_for(float largest) { return largest / 32768.0F; }
    static Stored encoded(float value) {
        constexpr float least_normal = 6.103515625e-5F;
        if (!(value >= least_normal || value <= -least_normal)) return 0;
        return Eigen::numext::bit_cast<std::uint16_t>(Eigen::half(value));
    }
    static float decoded(Stored stored) { return decoded(Four<Stored>{stored})[0]; }
    /// Moves sign, exponent and mantissa into place; 2^112 makes up for the exponents' offsets.
    static Four<float> decoded(Four<Stored> stored) {
        const auto wide = __builtin_convertvector(stored, Four<std::uint32_t>);
        const Four<std::uint32_t> bits = (wide & 0x7fffU) << 13U | (wide & 0x8000U) << 16U;
        Four<float> value;
        std::memcpy(&value, &bits, sizeof value);
        return value * 0x1p112F;
    }
};

/// Whole numbers from -127 to 127: errors of up to 1/254 of the column's largest magnitude.
struct ByteValue {
    using Stored = std::int8_t;
    static float scale_for(float largest) { return largest / 127.0F; }
    static Stored encoded(float value) {
        return static_cast<Stored>(value < 0 ? value - 0.5F : value + 0.5F);
    }
    static float decoded(Stored stored) { return static_cast<float>(stored); }
    static Four<float> decoded(Four<Stored> stored) {
        return __builtin_convertvector(stored, Four<float>);
    }
};

}  // namespace lightwell
