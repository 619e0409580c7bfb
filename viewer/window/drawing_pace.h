#pragma once

#include <optional>

#include "runtime/drawing/frame_view.h"

namespace lightwell {

/// What to draw next on a machine that cannot draw every pixel of every frame in time: while the
/// picture changes, fewer pixels; at rest all of them, some rows at a time, so that keys and mouse
/// are heard in between.
class DrawingPace {
  public:
    struct Part {
        int coarseness = 1;  ///< pixels a side that share one sample (FrameView::coarseness)
        PictureRows rows;    ///< all, if it is coarse
    };

    /// What is to be drawn now, if anything.
    /// @param changes  whether the picture differs from the last one
    /// @param now      on a clock that only goes forwards [s]
    std::optional<Part> next(bool changes, double now);
    /// What drawing that took.
    void took(double seconds);

    /// Whether something is still to be drawn, now or when things have come to rest.
    bool owes_more() const { return done_ < 1; }

  private:
    double whole_seconds_ = 4;  ///< that a picture of all pixels would take; at first, the worst
    double row_seconds_ = 0;    ///< the same, by the rows drawn last
    double sum_ = 0;            ///< of the rows drawn so far [s]
    double changed_ = 0;        ///< when
    double done_ = 1;           ///< share of the fine picture
    Part last_;
};

}  // namespace lightwell
