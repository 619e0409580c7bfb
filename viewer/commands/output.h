#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// Writes to standard output, which carries nothing but results.
/// @throws SystemError if it does not take all of the text.
void print_result(std::string_view text);

/// Writes a result to a file, or to standard output where `path` is empty.
/// @throws as print_result and write_atomically
void write_result(const std::string& path, std::string_view text);

/// Checks that a file to be written is none of those that are read, whatever they are called.
/// @throws InputError that names it
void require_not_read(const std::string& output, const std::vector<std::string>& read);

/// Writes "lightwell: message" to standard error.
void print_message(std::string_view message);

/// 12345678 as "12,345,678".
std::string grouped(std::uint64_t number);
/// A fraction of one with two digits: "5.3 %", "140 %".
std::string percent(double fraction);
/// Bytes for people: "812 B", "1.4 MiB".
std::string readable_bytes(std::uint64_t bytes);

}  // namespace lightwell
