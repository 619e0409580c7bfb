#pragma once

#include <cstddef>
#include <vector>

#include "radiance4d/scene/quad.h"
#include "runtime/drawing/camera_rays.h"

namespace lightwell {

/// A rectangle of pixels of a larger picture: columns [left, left + width) and rows
/// [top, top + height), counted from the picture's upper left corner.
struct PixelWindow {
    int left = 0;
    int top = 0;
    int width = 1;
    int height = 1;
};

/// The quad in every pixel of a window, as drawn: its index, -1 where there is none. The window is
/// surrounded by a margin of one pixel, so there are (width + 2) x (height + 2) numbers, the top
/// row first.
struct DrawnQuads {
    PixelWindow window;
    std::vector<int> quad;

    /// x in [-1, width], y in [-1, height], from the window's upper left pixel.
    int at(int x, int y) const {
        return quad[static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(window.width + 2) +
                    static_cast<std::size_t>(x + 1)];
    }
};

/// What the centre of each pixel of a window sees, row by row, the top row first.
struct SurfaceBuffer {
    int width = 0;
    int height = 0;
    std::vector<int> quad;       ///< index of the quad seen, -1: none
    std::vector<char> front;     ///< whether its front is seen
    std::vector<Vec3> position;  ///< where the pixel's ray meets it [m]; zero where there is none

    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
};

/// Turns drawn quads into surface points in double precision.
///
/// The ray of each pixel is met with the quad drawn there. Along edges the drawing is right to a
/// fraction of a pixel only, and may leave cracks where a quad's vertex lies on another's edge; so
/// where the pixels round about show other quads too, the ray is met with all of these and the
/// nearest is taken.
/// @param quads the quads that were drawn, planar and convex.
SurfaceBuffer meet_surfaces(const std::vector<Quad>& quads, const CameraRays& camera,
                            const DrawnQuads& drawn);

}  // namespace lightwell
