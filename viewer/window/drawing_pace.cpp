#include "viewer/window/drawing_pace.h"

namespace lightwell {

namespace {

constexpr double in_time = 0.04;  // what a picture that changes may take [s]
constexpr double rest = 0.25;     // after so long without a change it stays as it is [s]
constexpr int coarsest = 4;

}  // namespace

int DrawingPace::coarseness(bool changes, double now) {
    if (!changes) {
        if (now - changed_ >= rest) coarseness_ = 1;
        return coarseness_;
    }
    changed_ = now;
    coarseness_ = 1;
    while (coarseness_ < coarsest && whole_seconds_ > in_time * coarseness_ * coarseness_)
        ++coarseness_;
    return coarseness_;
}

void DrawingPace::took(double seconds) {
    whole_seconds_ = seconds * coarseness_ * coarseness_;
}

}  // namespace lightwell
