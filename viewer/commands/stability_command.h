#pragma once

namespace lightwell {

/// Measures how Lightwell does where methods like it fail, and prints the table on standard output,
/// row by row as it goes, or as one JSON object: row, criterion, what was reached, verdict.
/// @throws SystemError after the table if something is worse than is known; Interrupted between
/// rows if asked to stop
void run_stability(bool json);

}  // namespace lightwell
