#include "runtime/propagation/global_propagation.h"

#include <cmath>

#include <tbb/parallel_for.h>

#include "radiance4d/failure.h"
#include "runtime/propagation/column_blocks.h"

namespace lightwell {

namespace {

/// Rows of a block: 32 KiB of sums.
constexpr std::uint32_t block_rows = 2048;
/// Below so many columns, waking other threads takes longer than the work.
constexpr std::size_t fewest_columns_to_share = 256;

/// The columns of red, green and blue, one merged column at a time.
class MergedColumns {
  public:
    explicit MergedColumns(const GlobalTransport& transport) {
        for (std::size_t c = 0; c < 3; ++c)
            channel_[c] = &transport.indirect[static_cast<std::size_t>(transport.channel[c])];
    }

    bool is_grey() const { return channel_[0] == channel_[1] && channel_[1] == channel_[2]; }

    /// Coefficients of a column, rows ascending. Valid until the next call.
    const std::vector<MergedCoefficient>& column(std::uint32_t j) {
        merged_.clear();
        std::array<std::uint64_t, 3> at, end;
        for (std::size_t c = 0; c < 3; ++c) {
            at[c] = channel_[c]->column_start[j];
            end[c] = channel_[c]->column_start[j + 1];
        }
        for (;;) {
            constexpr std::uint32_t none = ~0U;
            std::uint32_t row = none;
            for (std::size_t c = 0; c < 3; ++c)
                if (at[c] < end[c]) row = std::min(row, channel_[c]->row[at[c]]);
            if (row == none) return merged_;
            MergedCoefficient next{row, {0, 0, 0}};
            for (std::size_t c = 0; c < 3; ++c)
                if (at[c] < end[c] && channel_[c]->row[at[c]] == row)
                    next.value[c] = channel_[c]->value[at[c]++];
            merged_.push_back(next);
        }
    }

  private:
    std::array<const TransportOperator*, 3> channel_;
    std::vector<MergedCoefficient> merged_;
};

}  // namespace

/// The blocks of all rows, whatever their values are held in.
class GlobalPropagation::Columns {
  public:
    virtual ~Columns() = default;
    virtual void append(std::uint32_t column, const std::vector<MergedCoefficient>& merged) = 0;
    virtual std::size_t block_count() const = 0;
    virtual void add(std::size_t block, const std::vector<std::uint32_t>& columns,
                     const PackedField& amount, PackedField& to, PackedField* also) const = 0;
    virtual std::uint64_t coefficients() const = 0;
    virtual std::uint64_t bytes() const = 0;
};

template <typename Value, std::size_t channels>
class GlobalPropagation::BlockedColumns : public Columns {
  public:
    explicit BlockedColumns(std::uint32_t size) {
        for (std::uint32_t first = 0; first < size; first += block_rows)
            blocks_.emplace_back(first);
    }

    void append(std::uint32_t column, const std::vector<MergedCoefficient>& merged) override {
        const MergedCoefficient* begin = merged.data();
        const MergedCoefficient* const end = begin + merged.size();
        for (std::size_t b = 0; b < blocks_.size() && begin != end; ++b) {
            const MergedCoefficient* stop = begin;
            while (stop != end && stop->row / block_rows == b)
                ++stop;
            blocks_[b].append(column, begin, stop);
            begin = stop;
        }
    }
    std::size_t block_count() const override { return blocks_.size(); }
    void add(std::size_t block, const std::vector<std::uint32_t>& columns,
             const PackedField& amount, PackedField& to, PackedField* also) const override {
        blocks_[block].add(columns, amount, to, also);
    }
    std::uint64_t coefficients() const override {
        std::uint64_t sum = 0;
        for (const auto& block : blocks_)
            sum += block.coefficients();
        return sum;
    }
    std::uint64_t bytes() const override {
        std::uint64_t sum = 0;
        for (const auto& block : blocks_)
            sum += block.bytes();
        return sum;
    }

  private:
    std::vector<ColumnBlock<Value, channels>> blocks_;
};

std::unique_ptr<GlobalPropagation::Columns> GlobalPropagation::blocked(
    const GlobalTransport& transport, ValueFormat format) {
    const std::uint32_t size = transport.space.functions();
    const bool grey = MergedColumns(transport).is_grey();
    const auto make = [&](auto value) -> std::unique_ptr<Columns> {
        using Value = decltype(value);
        if (grey) return std::make_unique<BlockedColumns<Value, 1>>(size);
        return std::make_unique<BlockedColumns<Value, 3>>(size);
    };
    switch (format) {
        case ValueFormat::half:
            return make(HalfValue());
        case ValueFormat::byte:
            return make(ByteValue());
        case ValueFormat::single:
            break;
    }
    return make(SingleValue());
}

GlobalPropagation::GlobalPropagation(const GlobalTransport& transport, ValueFormat format)
    : columns_(blocked(transport, format)) {
    MergedColumns merged(transport);
    energy_.reserve(transport.space.functions());
    for (std::uint32_t j = 0; j < transport.space.functions(); ++j) {
        const std::vector<MergedCoefficient>& column = merged.column(j);
        columns_->append(j, column);
        double squares = 0;
        for (const MergedCoefficient& coefficient : column)
            for (const float value : coefficient.value)
                squares += static_cast<double>(value) * static_cast<double>(value);
        energy_.push_back(static_cast<float>(std::sqrt(squares)));
    }
}

GlobalPropagation::~GlobalPropagation() = default;
GlobalPropagation::GlobalPropagation(GlobalPropagation&&) noexcept = default;
GlobalPropagation& GlobalPropagation::operator=(GlobalPropagation&&) noexcept = default;

std::uint64_t GlobalPropagation::coefficients() const {
    return columns_->coefficients();
}

std::uint64_t GlobalPropagation::bytes() const {
    return columns_->bytes();
}

void GlobalPropagation::collect(const PackedField& field,
                                std::vector<std::uint32_t>& columns) const {
    columns.clear();
    for (std::uint32_t j = 0; j < size(); ++j)
        if (energy_[j] > 0 && (field.col(j) != 0).any()) columns.push_back(j);
}

void GlobalPropagation::apply(const PackedField& direct, PackedField& indirect) const {
    std::vector<std::uint32_t> columns;
    collect(direct, columns);
    indirect.setZero();
    add(columns, direct, indirect);
}

void GlobalPropagation::add(const std::vector<std::uint32_t>& columns, const PackedField& amount,
                            PackedField& to, PackedField* also) const {
    LIGHTWELL_CHECK_OP(amount.cols(), ==, static_cast<Eigen::Index>(size()));
    LIGHTWELL_CHECK_OP(to.cols(), ==, static_cast<Eigen::Index>(size()));
    const auto add_block = [&](std::size_t block) {
        columns_->add(block, columns, amount, to, also);
    };
    if (columns.size() < fewest_columns_to_share)
        for (std::size_t block = 0; block < columns_->block_count(); ++block)
            add_block(block);
    else
        tbb::parallel_for(std::size_t{0}, columns_->block_count(), add_block);
}

}  // namespace lightwell
