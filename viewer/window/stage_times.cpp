#include "viewer/window/stage_times.h"

#include <algorithm>

namespace lightwell {

void StageHistory::add(const StageTimes& times) {
    if (ring_.size() < length)
        ring_.push_back(times);
    else
        ring_[next_] = times;
    next_ = (next_ + 1) % length;
}

std::vector<StageTimes> StageHistory::frames() const {
    std::vector<StageTimes> frames = ring_;
    if (frames.size() == length)
        std::rotate(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(next_),
                    frames.end());
    return frames;
}

double StageHistory::median(std::size_t stage) const {
    std::vector<double> needed;
    for (const StageTimes& times : ring_)
        if (times.in_order()[stage] > 0) needed.push_back(times.in_order()[stage]);
    if (needed.empty()) return 0;
    const auto middle = needed.begin() + static_cast<std::ptrdiff_t>(needed.size() / 2);
    std::nth_element(needed.begin(), middle, needed.end());
    return *middle;
}

}  // namespace lightwell
