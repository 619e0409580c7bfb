#pragma once

namespace lightwell {

/// How coarsely to draw on a machine that cannot draw every pixel of every frame in time: while the
/// picture changes, fewer pixels; at rest all of them.
class DrawingPace {
  public:
    /// Pixels a side that share one sample (FrameView::coarseness), 1 to 4.
    /// @param changes  whether the picture differs from the last one
    /// @param now      on a clock that only goes forwards [s]
    int coarseness(bool changes, double now);
    /// What drawing a picture took, as coarsely as was said last.
    void took(double seconds);

    /// Whether the last picture was a coarse one, which a finer one must follow.
    bool owes_a_fine_picture() const { return coarseness_ > 1; }

  private:
    double whole_seconds_ = 0;  ///< that a picture of all pixels would take
    double changed_ = 0;        ///< when
    int coarseness_ = 1;
};

}  // namespace lightwell
