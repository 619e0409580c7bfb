#pragma once

#include "runtime/propagation/global_propagation.h"

namespace lightwell {

/// What rounding the coefficients of H to a format does to them: the norm of the change over the
/// norm of H (Frobenius). Light that consists of many coefficients is changed by about as much.
double rounding_of(const GlobalTransport& transport, ValueFormat format);

struct FormatPolicy {
    /// Operators of at most so many bytes, which caches hold, stay as they are: that is fastest.
    std::uint64_t cached_bytes = std::uint64_t{32} << 20U;
    /// Share of the operator's own error that rounding may add.
    double share_of_error = 0.1;
};

/// The format that takes the least memory of those that the operator's own error allows, as its
/// file states it (estimated, else asked for); `single` where it states none, and for small ones.
ValueFormat fitting_format(const GlobalTransport& transport, const FormatPolicy& policy = {});

}  // namespace lightwell
