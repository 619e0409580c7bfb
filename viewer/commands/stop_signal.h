#pragma once

namespace lightwell {

/// From here on SIGINT (Ctrl-C) and SIGTERM ask the program to stop instead of ending it; a second
/// one of the same kind ends it.
void heed_stop_signals();

/// Whether such a signal has come.
bool stop_requested();

}  // namespace lightwell
