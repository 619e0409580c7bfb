#pragma once

#include <string>
#include <string_view>

namespace lightwell {

/// Writes a whole file so that `path` holds either what it held before or all of `bytes`.
///
/// The bytes go to a temporary beside the target, are forced to the disk, closed, read back and
/// compared; only then does the temporary take the target's name. A symbolic link is followed: the
/// file that it names is replaced. Whatever goes wrong, no temporary stays behind.
/// @throws InputError if the folder does not exist, if something other than a regular file has that
/// name, or if there can be no such name; SystemError if the disk is full or the folder may not be
/// written to.
void write_atomically(const std::string& path, std::string_view bytes);

/// Checks, before long work, that write_atomically could make a file of that name now: a temporary
/// is made beside it and removed again.
/// @throws as write_atomically
void require_writable(const std::string& path);

}  // namespace lightwell
