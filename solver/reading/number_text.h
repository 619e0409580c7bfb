#pragma once

#include <cstdint>
#include <string_view>

#include "radiance4d/failure.h"

namespace lightwell {

/// The finite number that `text` spells, whole, whatever the locale. A leading plus is allowed; a
/// number too small for a double is 0.
/// @throws InputError at `place` with the text if it is malformed, not a number (nan), infinite or
/// too large.
double number_from(std::string_view text, const Place& place);

/// As number_from for a whole number.
std::int64_t whole_number_from(std::string_view text, const Place& place);

}  // namespace lightwell
