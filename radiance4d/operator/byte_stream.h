#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "radiance4d/scene/quad.h"

namespace lightwell {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
              "the operator file is little-endian and copied as it is");

/// Collects numbers and text as little-endian bytes.
class ByteWriter {
  public:
    template <typename Number>
    void number(Number value) {
        static_assert(std::is_arithmetic_v<Number>);
        char bytes[sizeof(Number)];
        std::memcpy(bytes, &value, sizeof(Number));
        bytes_.append(bytes, sizeof(Number));
    }
    /// A count or an index, which fits in 32 bits.
    void count(std::size_t value);
    void text(std::string_view value);
    void triple(const Vec3& value);
    void triple(const Rgb& value) { triple(Vec3(value.matrix())); }

    const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

/// Takes numbers and text out of the content of a chunk, never beyond its end.
/// All methods throw InputError that starts with the place if the content does not hold what is
/// asked for.
class ByteReader {
  public:
    /// @param place  names file and chunk in messages
    ByteReader(std::string_view bytes, std::string place)
        : bytes_(bytes), place_(std::move(place)) {}

    template <typename Number>
    Number number() {
        static_assert(std::is_arithmetic_v<Number>);
        Number value;
        std::memcpy(&value, take(sizeof(Number)).data(), sizeof(Number));
        return value;
    }
    /// A number of things that take at least `least_bytes` each, so that no more are announced
    /// than can follow.
    std::uint32_t count(std::size_t least_bytes);
    /// A number below `bound`, in one byte.
    int choice(int bound);
    /// A number that fits in an int.
    int index();
    std::string text();
    Vec3 triple();
    Rgb colour() { return triple().array(); }
    std::string_view take(std::size_t size);
    std::size_t left() const { return bytes_.size() - next_; }

    /// Refuses bytes that nothing asked for.
    void finish() const;
    /// Refuses the content here.
    [[noreturn]] void fail(const std::string& flaw) const;
    /// Refuses the content as a whole, unless the flaw is empty.
    void require_no(const std::string& flaw) const;

  private:
    std::string_view bytes_;
    std::string place_;
    std::size_t next_ = 0;
};

}  // namespace lightwell
