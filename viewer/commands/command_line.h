#pragma once

namespace lightwell {

/// Runs the program with the arguments of main. Results go to standard output; messages go to
/// standard error as "lightwell: file:line:column: message".
/// @return the exit status: 0 for success, 1 for a mistake in the user's files or arguments, 2 for
/// a failure of the system (disk, memory, OpenGL) or of the program itself, 3 after an interruption
/// (Ctrl-C)
int run_command_line(int argc, const char* const* argv);

}  // namespace lightwell
