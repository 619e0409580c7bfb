#pragma once

#include <string>

#include "radiance4d/operator/byte_stream.h"
#include "radiance4d/operator/global_transport.h"

namespace lightwell {

/// Content of chunk PROV. @throws BrokenInvariant if a number is not finite or the options are no
/// JSON object
std::string provenance_bytes(const Provenance& provenance, const std::string& options_json);

/// Reads the chunk. @throws InputError
Provenance read_provenance(ByteReader& reader, std::string& options_json);

}  // namespace lightwell
