#include "viewer/window/drawing_pace.h"

#include <algorithm>

namespace lightwell {

namespace {

constexpr double in_time = 0.04;  // what a picture that changes may take [s]
constexpr double patience = 0.1;  // what a part of a picture at rest may take [s]
constexpr double rest = 0.25;     // after so long without a change it becomes a fine one [s]
constexpr double fewest_rows = 1.0 / 128;
constexpr int coarsest = 8;

}  // namespace

std::optional<DrawingPace::Part> DrawingPace::next(bool changes, double now) {
    if (changes) {
        changed_ = now;
        last_ = {};
        while (last_.coarseness < coarsest &&
               whole_seconds_ > in_time * last_.coarseness * last_.coarseness)
            ++last_.coarseness;
        done_ = last_.coarseness == 1 ? 1 : 0;
        return last_;
    }
    if (done_ >= 1 || (done_ == 0 && now - changed_ < rest)) return std::nullopt;
    if (done_ == 0) {
        row_seconds_ = whole_seconds_;
        sum_ = 0;
    }
    const double share = std::max(fewest_rows, patience / std::max(row_seconds_, patience));
    last_ = {1, {done_, std::min(1.0, done_ + share)}};
    done_ = last_.rows.to;
    return last_;
}

void DrawingPace::took(double seconds) {
    const double share = last_.rows.to - last_.rows.from;
    if (share == 1) {
        whole_seconds_ = seconds * last_.coarseness * last_.coarseness;
        return;
    }
    // What lies above may be dearer, but not by any amount.
    row_seconds_ = std::max(seconds / share, 0.25 * row_seconds_);
    sum_ += seconds;
    if (last_.rows.to == 1) whole_seconds_ = sum_;
}

}  // namespace lightwell
