#pragma once

#include <chrono>
#include <map>
#include <string>

namespace lightwell {

/// Adds the time since the last lap to the named stage, and to "total".
class StageClock {
  public:
    explicit StageClock(std::map<std::string, double>& seconds) : seconds_(seconds) {}
    ~StageClock() { lap("other"); }
    StageClock(const StageClock&) = delete;
    StageClock& operator=(const StageClock&) = delete;

    void lap(const std::string& stage) {
        const auto now = std::chrono::steady_clock::now();
        const double passed = std::chrono::duration<double>(now - last_).count();
        seconds_[stage] += passed;
        seconds_["total"] += passed;
        last_ = now;
    }

  private:
    std::map<std::string, double>& seconds_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace lightwell
