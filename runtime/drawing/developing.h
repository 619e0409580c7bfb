#pragma once

#include "runtime/drawing/frame_view.h"
#include "runtime/drawing/gl_objects.h"

namespace lightwell {

/// Triangles that cover the picture, for shaders that work pixel by pixel. Their vertex shader is
/// covering_vertex_shader().
class Covering {
  public:
    /// Keeps a reference to `gl`.
    explicit Covering(const GlFunctions& gl) : gl_(gl), corners_(make_vertex_array(gl)) {}

    /// With the program in use; leaves no vertex array bound.
    void draw() const;

  private:
    const GlFunctions& gl_;
    GlObject corners_;
};

/// The last pass of a frame: from light to a display's colours, by exposure, tone curve or false
/// colours.
class Developing {
  public:
    /// Keeps references to both.
    Developing(const GlFunctions& gl, const Covering& covering);

    /// Draws into the framebuffer that is bound, from its lower left corner on, as sRGB-encoded
    /// colours; GL_FRAMEBUFFER_SRGB is switched off.
    /// @param light  a texture with the samples of view.picture
    void draw(unsigned light, const FrameView& view, int width, int height) const;

  private:
    const GlFunctions& gl_;
    const Covering& covering_;
    GlObject program_;
};

}  // namespace lightwell
