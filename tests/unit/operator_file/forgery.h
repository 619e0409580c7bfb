#pragma once

#include <functional>
#include <string>

namespace lightwell::testing {

/// Writes to `to` a copy of the operator file `from` in which the contents of chunks were changed,
/// with lengths, scene hash and checksums made to match: only the contents can give it away.
/// @param change  called with tag and content of each chunk in turn; may change both
void forge(const std::string& from, const std::string& to,
           const std::function<void(std::string& tag, std::string& content)>& change);

/// The head of an operator file with its checksum made to match, after a change.
std::string with_valid_head(std::string bytes);

}  // namespace lightwell::testing
