#pragma once

#include <string>
#include <string_view>

#include "radiance4d/operator/byte_stream.h"
#include "radiance4d/operator/transport_operator.h"

namespace lightwell {

/// Content of chunks DTOI and GTOI: where the coefficients stand.
std::string index_bytes(const TransportOperator& operator_);
/// Content of chunks DTOV and GTOV: their values.
std::string value_bytes(const TransportOperator& operator_);

/// The inverse of index_bytes: `value` stays empty. Rows may still be out of range or order (see
/// flaw_of_operator). @throws InputError if counts and lengths do not agree
TransportOperator read_index(ByteReader& reader);
/// The inverse of value_bytes, for as many coefficients as the index announced. @throws InputError
void read_values(ByteReader& reader, TransportOperator& operator_);

}  // namespace lightwell
