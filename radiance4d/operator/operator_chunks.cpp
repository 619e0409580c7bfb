#include "radiance4d/operator/operator_chunks.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <fmt/format.h>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

/// Byte planes needed for numbers up to `largest`: at least one, so that a chunk is never shorter
/// than it has coefficients.
std::uint32_t planes_for(std::uint32_t largest) {
    return largest < (1U << 8) ? 1 : largest < (1U << 16) ? 2 : largest < (1U << 24) ? 3 : 4;
}

/// All lowest bytes first, then all of the next: bytes of like meaning pack well.
std::string planes_of(const std::uint32_t* numbers, std::size_t count, std::uint32_t planes) {
    std::string bytes(count * planes, '\0');
    for (std::uint32_t p = 0; p < planes; ++p)
        for (std::size_t k = 0; k < count; ++k)
            bytes[p * count + k] = static_cast<char>(numbers[k] >> (8 * p));
    return bytes;
}

/// The inverse of planes_of: numbers `begin` to `begin + size` of `count`. Planes that are not
/// there are zero.
void gather_planes(std::string_view bytes, std::size_t count, std::uint32_t planes,
                   std::size_t begin, std::size_t size, std::uint32_t* numbers) {
    std::fill_n(numbers, size, 0U);
    for (std::uint32_t p = 0; p < planes; ++p) {
        const auto* plane = reinterpret_cast<const std::uint8_t*>(bytes.data()) + p * count + begin;
        for (std::size_t k = 0; k < size; ++k)
            numbers[k] |= std::uint32_t{plane[k]} << (8 * p);
    }
}

/// Appends numbers of four bytes, block by block: each is small enough for the cache, and memory
/// that is about to be written is not cleared first.
template <typename Number>
void append_planes(std::string_view bytes, std::size_t count, std::uint32_t planes,
                   std::vector<Number>& numbers) {
    static_assert(sizeof(Number) == sizeof(std::uint32_t));
    std::array<std::uint32_t, 4096> bits;
    std::array<Number, 4096> block;
    numbers.reserve(numbers.size() + count);
    for (std::size_t begin = 0; begin < count; begin += block.size()) {
        const std::size_t size = std::min(block.size(), count - begin);
        gather_planes(bytes, count, planes, begin, size, bits.data());
        std::memcpy(block.data(), bits.data(), sizeof(Number) * size);
        numbers.insert(numbers.end(), block.begin(), block.begin() + size);
    }
}

/// The gaps before the rows of each column; the row before the first is -1.
std::vector<std::uint32_t> gaps_of(const TransportOperator& operator_) {
    std::vector<std::uint32_t> gaps(operator_.row.size());
    for (std::uint32_t column = 0; column < operator_.size; ++column) {
        std::uint32_t next = 0;
        for (std::uint64_t k = operator_.column_start[column];
             k < operator_.column_start[column + 1]; ++k) {
            gaps[k] = operator_.row[k] - next;
            next = operator_.row[k] + 1;
        }
    }
    return gaps;
}

/// The inverse of gaps_of, in place. Damaged gaps may wrap around; the rows then do not ascend.
void rows_from_gaps(TransportOperator& operator_) {
    for (std::uint32_t column = 0; column < operator_.size; ++column) {
        std::uint32_t next = 0;
        for (std::uint64_t k = operator_.column_start[column];
             k < operator_.column_start[column + 1]; ++k) {
            operator_.row[k] += next;
            next = operator_.row[k] + 1;
        }
    }
}

}  // namespace

std::string index_bytes(const TransportOperator& operator_) {
    const std::vector<std::uint32_t> gaps = gaps_of(operator_);
    std::uint32_t largest = 0;
    for (const std::uint32_t gap : gaps)
        largest |= gap;
    const std::uint32_t planes = planes_for(largest);
    ByteWriter writer;
    writer.number(operator_.size);
    writer.number(planes);
    writer.number(std::uint64_t{gaps.size()});
    for (std::uint32_t column = 0; column < operator_.size; ++column)
        writer.count(operator_.column_start[column + 1] - operator_.column_start[column]);
    return writer.bytes() + planes_of(gaps.data(), gaps.size(), planes);
}

std::string value_bytes(const TransportOperator& operator_) {
    std::vector<std::uint32_t> bits(operator_.value.size());
    if (!bits.empty()) std::memcpy(bits.data(), operator_.value.data(), 4 * bits.size());
    return planes_of(bits.data(), bits.size(), 4);
}

TransportOperator read_index(ByteReader& reader) {
    TransportOperator operator_;
    operator_.size = reader.number<std::uint32_t>();
    const auto planes = reader.number<std::uint32_t>();
    const auto coefficients = reader.number<std::uint64_t>();
    if (planes < 1 || planes > 4) reader.fail(fmt::format("{} byte planes", planes));
    const std::string_view counts = reader.take(4 * std::size_t{operator_.size});
    if (coefficients != reader.left() / planes)
        reader.fail(fmt::format("{} coefficients are announced, {} are there", coefficients,
                                reader.left() / planes));

    operator_.column_start.resize(std::size_t{operator_.size} + 1);
    for (std::size_t column = 0; column < operator_.size; ++column) {
        std::uint32_t count = 0;
        std::memcpy(&count, counts.data() + 4 * column, 4);
        operator_.column_start[column + 1] = operator_.column_start[column] + count;
    }
    if (operator_.column_start.back() != coefficients)
        reader.fail("the columns do not add up to the coefficients");
    append_planes(reader.take(coefficients * planes), coefficients, planes, operator_.row);
    reader.finish();
    rows_from_gaps(operator_);
    return operator_;
}

void read_values(ByteReader& reader, TransportOperator& operator_) {
    const std::size_t count = operator_.row.size();
    if (reader.left() / 4 < count)
        reader.fail(fmt::format("{} values for {} coefficients", reader.left() / 4, count));
    append_planes(reader.take(4 * count), count, 4, operator_.value);
    reader.finish();
}

}  // namespace lightwell
