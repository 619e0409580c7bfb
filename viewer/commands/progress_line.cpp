#include "viewer/commands/progress_line.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "viewer/commands/stop_signal.h"

namespace lightwell {

namespace {

/// Ends of the stages within the whole work, as measured on the sample scenes.
struct StageSpan {
    const char* name;
    double begin;
    double end;
};
constexpr StageSpan stages[] = {
    {"elements", 0, 0.02},  {"preview", 0, 0.02},  {"links", 0.02, 0.35}, {"closure", 0.35, 0.4},
    {"operator", 0.4, 0.5}, {"series", 0.5, 0.75}, {"estimate", 0.75, 1}};

}  // namespace

ProgressLine::ProgressLine(ShareOfWork share_of_work) : share_of_work_(std::move(share_of_work)) {}

ProgressLine::~ProgressLine() {
    if (is_shown_) fmt::print(stderr, "\r\x1b[K");
}

void ProgressLine::show(const std::string& stage, double share) {
    constexpr std::chrono::milliseconds pause(100);
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = Clock::now();
    if (is_shown_ && now - last_shown_ < pause) return;
    last_shown_ = now;
    is_shown_ = true;
    const double done = share_of_work_(stage, share);
    const double passed = std::chrono::duration<double>(now - start_).count();
    // An estimate from too little work would only confuse.
    const std::string remaining =
        done > 0.03 ? ", about " + readable_duration(passed * (1 - done) / done) + " left" : "";
    fmt::print(stderr, "\r\x1b[K{:3.0f} % ({}){}", 100 * done, stage, remaining);
    std::fflush(stderr);
}

bool ProgressLine::fits_standard_error() {
    return isatty(STDERR_FILENO) == 1;
}

Progress progress_on(std::optional<ProgressLine>& line, bool wanted,
                     ProgressLine::ShareOfWork share_of_work) {
    Progress progress;
    progress.stop_requested = stop_requested;
    if (wanted && ProgressLine::fits_standard_error()) {
        line.emplace(std::move(share_of_work));
        progress.report = [&line](const std::string& stage, double share) {
            line->show(stage, share);
        };
    }
    return progress;
}

double share_of_precomputation(const std::string& stage, double share) {
    const auto* const known = std::find_if(std::begin(stages), std::end(stages),
                                           [&](const StageSpan& s) { return stage == s.name; });
    if (known == std::end(stages)) return 0;
    return known->begin + (known->end - known->begin) * std::clamp(share, 0.0, 1.0);
}

std::string readable_duration(double seconds) {
    const auto whole = static_cast<long long>(std::ceil(seconds));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace lightwell
