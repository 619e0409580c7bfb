#pragma once

#include <cstdint>
#include <string>

namespace lightwell {

/// The bytes of a user's file.
/// @param limit largest size taken in [bytes]; a larger file is refused before memory is taken
/// @throws InputError if it does not exist, is not a regular file (directories, devices and pipes
/// are refused: they have no size to check and may never end) or is too large; SystemError if the
/// disk fails.
std::string read_bytes(const std::string& path, std::int64_t limit);

/// As read_bytes, for text: a UTF-8 byte order mark is removed.
/// @throws InputError also for UTF-16 and UTF-32, which show by their byte order mark or by zero
/// bytes among the first characters.
std::string read_text(const std::string& path, std::int64_t limit);

/// Text of the user's for a message: in single quotes, at most 40 bytes, anything that is not
/// printable ASCII or UTF-8 shown as \xNN.
std::string in_quotes(const std::string& text);

}  // namespace lightwell
