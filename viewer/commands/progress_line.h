#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "radiance4d/progress.h"

namespace lightwell {

/// One line on standard error that is written over and over: the percentage of the work done and
/// the time it will still take. It disappears with its owner.
class ProgressLine {
  public:
    ProgressLine();
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// To be called with what Progress::report is called with, from any thread.
    void show(const std::string& stage, double share);

    /// Whether standard error is a terminal, the only place for such a line.
    static bool fits_standard_error();

  private:
    using Clock = std::chrono::steady_clock;

    std::mutex mutex_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_shown_;
    bool is_shown_ = false;
};

/// The part of a whole precomputation that is done when `stage` has done `share` of its own work,
/// in [0,1], as such work usually divides.
double share_of_precomputation(const std::string& stage, double share);

/// "12 s", "3 min 20 s", "1 h 05 min".
std::string readable_duration(double seconds);

}  // namespace lightwell
