#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "radiance4d/progress.h"

namespace lightwell {

/// One line on standard error that is written over and over: the percentage of the work done and
/// the time it will still take. It disappears with its owner.
class ProgressLine {
  public:
    /// The part of the whole work that is done when a stage has done a share of its own.
    using ShareOfWork = std::function<double(const std::string& stage, double share)>;

    explicit ProgressLine(ShareOfWork share_of_work);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// To be called with what Progress::report is called with, from any thread.
    void show(const std::string& stage, double share);

    /// Whether standard error is a terminal, the only place for such a line.
    static bool fits_standard_error();

  private:
    using Clock = std::chrono::steady_clock;

    ShareOfWork share_of_work_;
    std::mutex mutex_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_shown_;
    bool is_shown_ = false;
};

/// Progress that heeds stop signals, and that a line shows where standard error is a terminal and
/// it is wanted.
/// @param line  what owns the line; must outlive the progress
Progress progress_on(std::optional<ProgressLine>& line, bool wanted,
                     ProgressLine::ShareOfWork share_of_work);

/// The part of a whole precomputation that is done when `stage` has done `share` of its own work,
/// in [0,1], as such work usually divides.
double share_of_precomputation(const std::string& stage, double share);

/// "12 s", "3 min 20 s", "1 h 05 min".
std::string readable_duration(double seconds);

}  // namespace lightwell
