#pragma once

#include <functional>

namespace lightwell {

/// Does a program's work, and says on standard error what went wrong with it.
/// @return the exit status: 0 for success, 1 for a mistake in the user's files or arguments, 2 for
/// a failure of the system (disk, memory, display, OpenGL) or of the program itself, 3 after an
/// interruption (Ctrl-C)
int exit_status_of(const std::function<void()>& work);

}  // namespace lightwell
