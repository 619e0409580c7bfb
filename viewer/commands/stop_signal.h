#pragma once

namespace lightwell {

/// From here on SIGINT (Ctrl-C) and SIGTERM ask the program to stop instead of ending it; a second
/// one of the same kind ends it. A file that outgrows a limit (SIGXFSZ) does not end it either:
/// writing it fails, as on a full disk.
void heed_stop_signals();

/// Whether such a signal has come.
bool stop_requested();

}  // namespace lightwell
