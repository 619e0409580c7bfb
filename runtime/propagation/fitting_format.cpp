#include "runtime/propagation/fitting_format.h"

#include <algorithm>
#include <cmath>

#include "runtime/propagation/stored_values.h"

namespace lightwell {

namespace {

/// Sums of squares: of values, and of what rounding changes.
struct Squares {
    double values = 0, changes = 0;
};

template <typename Value>
Squares squares_of(const TransportOperator& channel) {
    Squares sum;
    for (std::uint32_t j = 0; j < channel.size; ++j) {
        const auto begin =
            channel.value.begin() + static_cast<std::ptrdiff_t>(channel.column_start[j]);
        const auto end =
            channel.value.begin() + static_cast<std::ptrdiff_t>(channel.column_start[j + 1]);
        float largest = 0;
        for (auto value = begin; value != end; ++value)
            largest = std::max(largest, std::abs(*value));
        if (!(largest > 0)) continue;
        const float scale = Value::scale_for(largest);
        for (auto value = begin; value != end; ++value) {
            const double rounded =
                static_cast<double>(scale * Value::decoded(Value::encoded(*value / scale)));
            const auto exact = static_cast<double>(*value);
            sum.values += exact * exact;
            sum.changes += (rounded - exact) * (rounded - exact);
        }
    }
    return sum;
}

Squares squares_of(const TransportOperator& channel, ValueFormat format) {
    switch (format) {
        case ValueFormat::half:
            return squares_of<HalfValue>(channel);
        case ValueFormat::byte:
            return squares_of<ByteValue>(channel);
        case ValueFormat::single:
            break;
    }
    return squares_of<SingleValue>(channel);
}

}  // namespace

double rounding_of(const GlobalTransport& transport, ValueFormat format) {
    Squares all;
    for (const TransportOperator& channel : transport.indirect) {
        const Squares here = squares_of(channel, format);
        all.values += here.values;
        all.changes += here.changes;
    }
    return all.values > 0 ? std::sqrt(all.changes / all.values) : 0;
}

ValueFormat fitting_format(const GlobalTransport& transport, const FormatPolicy& policy) {
    std::uint64_t bytes = 0;
    for (const TransportOperator& channel : transport.indirect)
        bytes += channel.coefficients() * (sizeof(float) + sizeof(std::uint16_t));
    if (bytes <= policy.cached_bytes) return ValueFormat::single;
    const Provenance& of = transport.provenance;
    const double error = of.error_estimated > 0 ? of.error_estimated : of.error_asked;
    for (const ValueFormat format : {ValueFormat::byte, ValueFormat::half})
        if (rounding_of(transport, format) <= policy.share_of_error * error) return format;
    return ValueFormat::single;
}

}  // namespace lightwell
