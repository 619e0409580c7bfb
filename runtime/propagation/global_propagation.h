#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "runtime/propagation/packed_field.h"

namespace lightwell {

/// How the coefficients of H are held at run time. Where all of H fits into the cache, `single` is
/// the fastest; the others are for operators that do not.
enum class ValueFormat {
    single,  ///< floats, as in the file
    half,    ///< half floats and a scale per column: 1 part in 4,096 of each coefficient
    byte,    ///< 8 bits and a scale per column: 1/254 of a column's largest coefficient
};

/// The indirect light of a scene, H E, by the global transport operator (WRT section 5.2), touching
/// only the non-zero coefficients of E.
///
/// The channels are merged: a coefficient that red, green and blue have in the same place is found
/// once. Rows are cut into blocks; a block's part of every column lies together, so that one core
/// adds up a piece of the result that stays in its cache. Sums are in the same order whatever the
/// number of threads.
class GlobalPropagation {
  public:
    explicit GlobalPropagation(const GlobalTransport& transport,
                               ValueFormat format = ValueFormat::single);
    ~GlobalPropagation();
    GlobalPropagation(GlobalPropagation&&) noexcept;
    GlobalPropagation& operator=(GlobalPropagation&&) noexcept;

    /// Basis functions.
    std::uint32_t size() const { return static_cast<std::uint32_t>(energy_.size()); }
    /// Norm of column j of H over all rows and channels: how much of a unit change of E_j comes
    /// back. Zero where the column is empty, which is common among the finest wavelets.
    const std::vector<float>& energy() const { return energy_; }
    /// Places that hold a coefficient of at least one channel.
    std::uint64_t coefficients() const;
    /// Memory that the coefficients take.
    std::uint64_t bytes() const;

    /// indirect <- H direct. Both have size() columns.
    void apply(const PackedField& direct, PackedField& indirect) const;

    /// Puts into `columns` (cleared first) those where the field is not zero nor H empty,
    /// ascending.
    void collect(const PackedField& field, std::vector<std::uint32_t>& columns) const;

    /// to <- to + H amount for the columns listed, which ascend; the rest of `amount` is not read.
    /// If `also` is given the same is added to it.
    void add(const std::vector<std::uint32_t>& columns, const PackedField& amount, PackedField& to,
             PackedField* also = nullptr) const;

  private:
    class Columns;
    template <typename Value, std::size_t channels>
    class BlockedColumns;

    static std::unique_ptr<Columns> blocked(const GlobalTransport& transport, ValueFormat format);

    std::unique_ptr<Columns> columns_;
    std::vector<float> energy_;
};

}  // namespace lightwell
