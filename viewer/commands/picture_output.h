#pragma once

#include <optional>
#include <string>

#include "viewer/commands/picture_view.h"
#include "viewer/images/image.h"

namespace lightwell {

/// Writes linear pictures of one view into files: an EXR holds the light itself, a PNG is exposed
/// and toned, or coloured, for a display. What suits the first picture, its exposure or the top of
/// its false colours, is kept for all that follow.
class PictureOutput {
  public:
    /// @param exposure  of a PNG [EV], beside the automatic one
    /// @param contours  whether false colours have contour lines
    PictureOutput(View view, double exposure, bool contours);

    /// Says on standard error if there were pixels that are not finite.
    /// @throws as write_png and write_exr
    void write(const Image& light, const std::string& path);

  private:
    Image for_display(const Image& light);

    View view_;
    double exposure_;
    bool contours_;
    std::optional<double> automatic_exposure_, maximum_;
};

}  // namespace lightwell
