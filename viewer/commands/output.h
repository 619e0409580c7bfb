#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lightwell {

/// Writes to standard output, which carries nothing but results.
/// @throws SystemError if it does not take all of the text.
void print_result(std::string_view text);

/// Writes a result to a file, or to standard output where `path` is empty.
/// @throws as print_result and write_atomically
void write_result(const std::string& path, std::string_view text);

/// Writes "lightwell: message" to standard error.
void print_message(std::string_view message);

/// 12345678 as "12,345,678".
std::string grouped(std::uint64_t number);
/// Bytes for people: "812 B", "1.4 MiB".
std::string readable_bytes(std::uint64_t bytes);

}  // namespace lightwell
