#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "runtime/propagation/packed_field.h"
#include "runtime/propagation/stored_values.h"

namespace lightwell {

/// One coefficient of H with the values of its distinct channels.
struct MergedCoefficient {
    std::uint32_t row = 0;
    std::array<float, 3> value = {0, 0, 0};
};

/// The columns of H, restricted to a range of rows that fits into a core's cache together with what
/// is added up there: a column's rows lie side by side, as 16-bit offsets, and so do the channels
/// of a value.
///
/// @tparam Value     how values are held, see stored_values.h
/// @tparam channels  1: the same value for red, green and blue; 3: one each
template <typename Value, std::size_t channels>
class ColumnBlock {
  public:
    /// At most 65,536 rows.
    explicit ColumnBlock(std::uint32_t first_row) : first_row_(first_row) { start_.push_back(0); }

    /// Columns come in ascending order; empty ones are left out.
    void append(std::uint32_t column, const MergedCoefficient* begin,
                const MergedCoefficient* end) {
        if (begin == end) return;
        float largest = 0;
        for (const MergedCoefficient* c = begin; c != end; ++c)
            for (std::size_t k = 0; k < channels; ++k)
                largest = std::max(largest, std::abs(c->value[k]));
        const float scale = largest > 0 ? Value::scale_for(largest) : 1;
        for (const MergedCoefficient* c = begin; c != end; ++c) {
            row_.push_back(static_cast<std::uint16_t>(c->row - first_row_));
            for (std::size_t k = 0; k < lanes; ++k)
                value_.push_back(Value::encoded(k < channels ? c->value[k] / scale : 0));
        }
        column_.push_back(column);
        scale_.push_back(scale);
        start_.push_back(static_cast<std::uint32_t>(row_.size()));
    }

    /// to <- to + A amount, and the same to `also` if given, for the columns listed (ascending).
    /// Every row is summed in the order of the columns: the result does not depend on who works on
    /// which block.
    void add(const std::vector<std::uint32_t>& columns, const PackedField& amount, PackedField& to,
             PackedField* also) const {
        auto here = column_.begin();
        for (const std::uint32_t column : columns) {
            here = first_not_below(here, column);
            if (here == column_.end()) return;
            if (*here != column) continue;
            const auto c = static_cast<std::size_t>(here - column_.begin());
            const Four<float> factor = four_at(amount.data() + 4 * std::size_t{column}) * scale_[c];
            add_column(c, factor, to.data() + 4 * std::size_t{first_row_});
            if (also != nullptr) add_column(c, factor, also->data() + 4 * std::size_t{first_row_});
        }
    }

    std::uint64_t coefficients() const { return row_.size(); }
    std::uint64_t bytes() const {
        return column_.size() * (sizeof(std::uint32_t) + sizeof(float)) +
               start_.size() * sizeof(std::uint32_t) + row_.size() * sizeof(std::uint16_t) +
               value_.size() * sizeof(typename Value::Stored);
    }

  private:
    static constexpr std::size_t lanes = channels == 1 ? 1 : 4;
    using ColumnIterator = std::vector<std::uint32_t>::const_iterator;

    /// As std::lower_bound from `from` on, in a time that grows with the logarithm of the distance.
    ColumnIterator first_not_below(ColumnIterator from, std::uint32_t column) const {
        std::ptrdiff_t step = 1;
        while (column_.end() - from > step && from[step] < column) {
            from += step;
            step *= 2;
        }
        return std::lower_bound(from, from + std::min(step + 1, column_.end() - from), column);
    }

    void add_column(std::size_t c, Four<float> factor, float* rows) const {
        for (std::size_t k = start_[c]; k < start_[c + 1]; ++k) {
            float* const target = rows + 4 * std::size_t{row_[k]};
            Four<float> sum = four_at(target);
            if constexpr (channels == 1)
                sum += factor * Value::decoded(value_[k]);
            else
                sum += factor * Value::decoded(four_at(value_.data() + 4 * k));
            std::memcpy(target, &sum, sizeof sum);
        }
    }

    std::uint32_t first_row_;
    std::vector<std::uint32_t> column_;  ///< those that are not empty here
    std::vector<std::uint32_t> start_;   ///< one more than columns: offsets into row_
    std::vector<float> scale_;           ///< by column
    std::vector<std::uint16_t> row_;     ///< from first_row_
    std::vector<typename Value::Stored> value_;
};

}  // namespace lightwell
