#include "solver/transport/directed_transport.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "radiance4d/basis/angular_reflection.h"
#include "radiance4d/failure.h"
#include "solver/transport/largest_first.h"
#include "solver/transport/sparse_analysis.h"

namespace lightwell {

namespace {

/// The sub-domains of a link, as axes: by cells (CellTree::position) before they are transformed,
/// by functions after.
enum class Axis : std::size_t { receiver_space, receiver_angle, sender_space, sender_angle };
constexpr std::size_t axes = 4;

/// The numbers of an entry along its axes, packed into one that sorts fast: an axis that is not in
/// front of others has the higher digits.
class PackedNumbers {
  public:
    /// @param counts  of the numbers along each axis
    explicit PackedNumbers(const std::array<std::uint32_t, axes>& counts) {
        int bits = 0;
        for (std::size_t a = 0; a < axes; ++a) {
            while ((counts[a] - 1) >> width_[a] != 0)
                ++width_[a];
            bits += width_[a];
        }
        LIGHTWELL_CHECK_OP(bits, <=, 64);
    }

    /// With the number along `last` in the lowest digits.
    std::uint64_t packed(const std::array<std::uint32_t, axes>& numbers, Axis last) const {
        std::uint64_t key = 0;
        for (std::size_t a = 0; a < axes; ++a)
            if (a != index(last)) key = key << width_[a] | numbers[a];
        return key << width_[index(last)] | numbers[index(last)];
    }
    std::array<std::uint32_t, axes> unpacked(std::uint64_t key, Axis last) const {
        std::array<std::uint32_t, axes> numbers{};
        const auto take = [&](std::size_t a) {
            numbers[a] = static_cast<std::uint32_t>(key & ((std::uint64_t{1} << width_[a]) - 1));
            key >>= width_[a];
        };
        take(index(last));
        for (std::size_t a = axes; a-- > 0;)
            if (a != index(last)) take(a);
        return numbers;
    }
    /// The bits of the number along an axis.
    int width(Axis axis) const { return width_[index(axis)]; }

  private:
    static std::size_t index(Axis axis) { return static_cast<std::size_t>(axis); }
    std::array<int, axes> width_{};
};

struct Entry {
    std::uint64_t key;  ///< its numbers, packed
    double value;
};

/// The entries of a block, transformed along some of their axes.
class TransformedEntries {
  public:
    /// By cells along all axes.
    TransformedEntries(const PackedNumbers& packing, std::size_t most) : packing_(packing) {
        entries_.reserve(most);
    }
    void add(const std::array<std::uint32_t, axes>& cells, double value) {
        entries_.push_back({packing_.packed(cells, last_), value});
    }

    /// Transforms along one axis: entries that agree in all other numbers are one function over it.
    void transform(const HaarBasis& basis, Axis axis) {
        for (Entry& entry : entries_)
            entry.key = packing_.packed(packing_.unpacked(entry.key, last_), axis);
        last_ = axis;
        std::sort(entries_.begin(), entries_.end(),
                  [](const Entry& a, const Entry& b) { return a.key < b.key; });
        const int width = packing_.width(axis);
        const std::uint64_t along = (std::uint64_t{1} << width) - 1;
        SparseAnalysis analyse(basis);
        transformed_.clear();
        std::vector<SparseValue> cells;
        for (std::size_t first = 0; first < entries_.size();) {
            const std::uint64_t others = entries_[first].key >> width;
            cells.clear();
            for (; first < entries_.size() && entries_[first].key >> width == others; ++first)
                cells.push_back({static_cast<std::uint32_t>(entries_[first].key & along),
                                 entries_[first].value});
            for (const SparseValue& coefficient : analyse(cells))
                transformed_.push_back({others << width | coefficient.index, coefficient.value});
        }
        std::swap(entries_, transformed_);
    }

    const std::vector<Entry>& entries() const { return entries_; }
    std::array<std::uint32_t, axes> numbers(const Entry& entry) const {
        return packing_.unpacked(entry.key, last_);
    }

  private:
    const PackedNumbers& packing_;
    Axis last_ = Axis::sender_angle;
    std::vector<Entry> entries_, transformed_;  // the latter for the memory that it holds
};

/// The block of P between two elements.
std::vector<Coefficient> pair_block(const RadianceSpace& space, const DirectedPair& pair) {
    const Element& x = space.element(pair.receiver);
    const Element& y = space.element(pair.sender);
    const HaarBasis angle_x = angular_basis(x.angle.levels());
    const HaarBasis angle_y = angular_basis(y.angle.levels());
    const PackedNumbers packing({x.space.tree().positions(), angle_x.tree().positions(),
                                 y.space.tree().positions(), angle_y.tree().positions()});
    TransformedEntries block(packing, pair.links.size());
    for (const DirectedLink& link : pair.links) {
        const double measure = x.space.area_at(link.receiver) *
                               angle_x.area_at(link.receiver_angle) * y.space.area_at(link.sender) *
                               angle_y.area_at(link.sender_angle);
        block.add({link.receiver, link.receiver_angle, link.sender, link.sender_angle},
                  link.exchange / std::sqrt(measure));
    }
    // The angular axes first: few cells share all the other numbers, so that they stay sparse
    // longest.
    if (x.angle.levels() > 0) block.transform(angle_x, Axis::receiver_angle);
    if (y.angle.levels() > 0) block.transform(angle_y, Axis::sender_angle);
    block.transform(x.space, Axis::receiver_space);
    block.transform(y.space, Axis::sender_space);

    double largest = 0;
    for (const Entry& entry : block.entries())
        largest = std::max(largest, std::abs(entry.value));
    std::vector<Coefficient> result;
    result.reserve(block.entries().size());
    for (const Entry& entry : block.entries()) {
        if (std::abs(entry.value) <= rounding_share * largest) continue;
        const auto [receiver, receiver_angle, sender, sender_angle] = block.numbers(entry);
        result.push_back({x.first + receiver * x.angle.functions() + receiver_angle,
                          y.first + sender * y.angle.functions() + sender_angle,
                          static_cast<float>(entry.value)});
    }
    return result;
}

}  // namespace

std::vector<Coefficient> directed_transport(const RadianceSpace& space,
                                            const std::vector<DirectedPair>& pairs,
                                            const Progress& progress) {
    std::vector<std::vector<Coefficient>> blocks(pairs.size());
    for_each_largest_first(
        pairs.size(), [&pairs](std::size_t p) { return pairs[p].links.size(); },
        [&](std::size_t p) {
            progress.check();
            blocks[p] = pair_block(space, pairs[p]);
        });
    return joined(std::move(blocks), space.functions());
}

}  // namespace lightwell
