#pragma once

#include <string>
#include <vector>

namespace lightwell {

/// Becomes the program with the window, lightwell-view, which lies beside this one: a program of
/// its own, so that this one needs neither a display nor the libraries that open windows.
/// @param words  what follows "lightwell view"
/// @throws SystemError if there is no such program; does not return otherwise
[[noreturn]] void run_view(const std::vector<std::string>& words);

}  // namespace lightwell
