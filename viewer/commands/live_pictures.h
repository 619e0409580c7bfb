#pragma once

#include <memory>
#include <vector>

#include "runtime/drawing/frame_renderer.h"
#include "runtime/frame.h"
#include "viewer/commands/arguments.h"
#include "viewer/commands/opened_operator.h"
#include "viewer/commands/picture_view.h"
#include "viewer/commands/projection_choice.h"
#include "viewer/images/image.h"
#include "viewer/offscreen/gl_context.h"

namespace lightwell {

/// Draws pictures as a window does, one after the other, without a display: direct light by
/// FrameRenderer, indirect light from the textures of Frame.
class LivePictures {
  public:
    /// @param samples  a side in every pixel, at most 4
    /// @throws InputError for more samples; SystemError if OpenGL fails
    LivePictures(const OpenedOperator& opened, View view, const PixelSize& size, int samples,
                 OffscreenGl opengl, ProjectionWay projection);

    /// The linear picture, in the view's unit.
    /// @throws InputError for a camera that cannot be used; SystemError if OpenGL fails
    Image drawn(const std::vector<Light>& lights, const Camera& camera);

  private:
    std::unique_ptr<GlContext> context_;
    Frame frame_;
    FrameRenderer renderer_;
    FrameView view_;
    PixelSize size_;
};

/// Draws the path of a file into numbered pictures, exposed alike: "walk.png" becomes
/// "walk-0001.png", "walk-0002.png", ... Progress is shown where standard error is a terminal.
struct PathRequest {
    std::string path_file;
    std::string output;
    View view = View::total;
    PixelSize size;
    int samples = 2;
    double exposure = 0;
    bool contours = false;
    Camera camera;              ///< where the path has none
    std::vector<Light> lights;  ///< beside those of the path
    OffscreenGl opengl = OffscreenGl::osmesa;
    ProjectionWay projection = ProjectionWay::rays;
};
/// @throws Interrupted between two pictures, with all that are there complete; InputError for a
/// path that cannot be used; SystemError if OpenGL or the disk fails
void draw_path(const OpenedOperator& opened, const PathRequest& request);

}  // namespace lightwell
