#include "radiance4d/operator/byte_stream.h"

#include <limits>

#include <fmt/format.h>

#include "radiance4d/failure.h"

namespace lightwell {

void ByteWriter::count(std::size_t value) {
    LIGHTWELL_CHECK_OP(value, <=, std::size_t{std::numeric_limits<std::uint32_t>::max()});
    number(static_cast<std::uint32_t>(value));
}

void ByteWriter::text(std::string_view value) {
    count(value.size());
    bytes_.append(value);
}

void ByteWriter::triple(const Vec3& value) {
    for (int axis = 0; axis < 3; ++axis)
        number(value[axis]);
}

std::uint32_t ByteReader::count(std::size_t least_bytes) {
    const auto value = number<std::uint32_t>();
    if (value > left() / least_bytes)
        fail(fmt::format("{} entries are announced, but only {} bytes follow", value, left()));
    return value;
}

int ByteReader::choice(int bound) {
    const int value = number<std::uint8_t>();
    if (value >= bound) fail(fmt::format("{} stands where at most {} may", value, bound - 1));
    return value;
}

int ByteReader::index() {
    const auto value = number<std::uint32_t>();
    if (value > static_cast<std::uint32_t>(std::numeric_limits<int>::max()))
        fail(fmt::format("{} is no index", value));
    return static_cast<int>(value);
}

std::string ByteReader::text() {
    const std::uint32_t size = count(1);
    return std::string(take(size));
}

Vec3 ByteReader::triple() {
    Vec3 value;
    for (int axis = 0; axis < 3; ++axis)
        value[axis] = number<double>();
    return value;
}

std::string_view ByteReader::take(std::size_t size) {
    if (size > left()) fail(fmt::format("{} bytes are needed, {} follow", size, left()));
    const std::string_view taken = bytes_.substr(next_, size);
    next_ += size;
    return taken;
}

void ByteReader::finish() const {
    if (left() > 0) fail(fmt::format("{} bytes are left over", left()));
}

void ByteReader::fail(const std::string& flaw) const {
    throw InputError(fmt::format("{}, byte {} of its content: {}", place_, next_, flaw));
}

void ByteReader::require_no(const std::string& flaw) const {
    if (!flaw.empty()) throw InputError(fmt::format("{}: {}", place_, flaw));
}

}  // namespace lightwell
